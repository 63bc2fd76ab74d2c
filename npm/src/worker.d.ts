import type { HeightMap, MakeOptions, Report, Source } from "./index.js";

export interface WantedResults {
  solids?: ("stl" | "3mf" | "ply" | "obj")[];
  heightMap?: { size?: number };
  preview?: { size?: number };
}

export interface WorkerRelief {
  report: Report;
  remarks: string[];
  solids: { [format: string]: Uint8Array };
  heightMap: HeightMap | null;
  preview: Uint8Array | null;
}

/** Makes reliefs in a worker. */
export declare class RelievoWorker {
  make(source: Source, options?: MakeOptions, results?: WantedResults): Promise<WorkerRelief>;
  sample(name: string, options?: { points?: number; noise?: number }): Promise<Uint8Array>;
  terminate(): void;
}
