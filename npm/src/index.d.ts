import type { ReliefOptions } from "./options.js";
export type { ReliefOptions };

export type Bytes = Uint8Array | ArrayBuffer;

/** A file that is read in blocks. read() fills `to` up to the end of the file, and returns the number of bytes. */
export interface ReadableFile {
  size: number;
  read(offset: number, to: Uint8Array): number;
}

/** A list of numbers, or a list of rows of numbers. */
export type Numbers = ArrayLike<number> | readonly ArrayLike<number>[];

export interface CloudArrays {
  /** x, y and z of each point. */
  points: Numbers;
  normals?: Numbers;
  /** Red, green and blue of each point, 0 to 255. */
  colours?: Numbers;
  /** The indices of the three points of each triangle. */
  faces?: Numbers;
}

export interface DepthArrays {
  /** Depths row by row, the top row first. 0 means a missing depth. */
  depths: Numbers;
  width: number;
  height: number;
}

/** A scan: the bytes of a file, an object that maps names to files, or arrays. */
export type Source = Bytes | ReadableFile | CloudArrays | DepthArrays | { [name: string]: Bytes | ReadableFile };

export interface InputOptions {
  /** The name of the file. Text formats are recognised by its ending. */
  name?: string;
  /** Files above this size are read in blocks if their format allows it. By default these are files above 512 MB, and
   * files with more than three million points and no triangles, which would fill the memory of WebAssembly. */
  streamAboveMb?: number;
  /** The height map of a base of the kind "image": a PNG or TIFF file. */
  baseImage?: Bytes | { name: string; bytes: Bytes };
}

export interface Watching {
  /** Called at the beginning of each stage. Returning false cancels. An error that it throws cancels and is thrown on. */
  progress?: (stage: string, fraction: number) => boolean | void;
  /** Cancels when it is aborted. It is checked between stages. */
  signal?: AbortSignal;
}

export type MakeOptions = ReliefOptions & InputOptions & Watching;
export type Units = "mm" | "in";

export interface HeightMap {
  width: number;
  height: number;
  mmPerPixel: number;
  /** Millimetres above the lowest point, row by row, the top row first. */
  heights: Float32Array;
}

export interface Report {
  height_mm: number;
  size_mm: [number, number, number];
  input_points: number;
  visible_points: number;
  seconds: { [stage: string]: number };
  [key: string]: unknown;
}

// Says how a height map is written. The flags of the command line have the same meaning.
export interface HeightMapFileOptions {
  size?: number; // longer side in pixels
  pixel?: number | string; // exact size of a pixel; replaces `size`
  dpi?: number;
  bits?: 8 | 16 | 32;
  area?: "plate" | "relief";
  zero?: "lowest" | "ground";
  high?: "white" | "black";
  units?: Units;
}

export declare class Relief {
  private constructor();
  readonly report: Report;
  readonly remarks: string[];
  solid(format?: "stl" | "3mf" | "ply" | "obj", options?: { units?: Units }): Uint8Array;
  heightMapFile(format?: "png" | "tif" | "tiff", options?: HeightMapFileOptions): Uint8Array;
  preview(options?: { size?: number }): Uint8Array;
  toolPicture(): Uint8Array;
  heightMap(options?: { size?: number }): HeightMap;
  readonly vertices: Float64Array;
  readonly faces: Uint32Array;
}

export declare function make(source: Source, options?: MakeOptions): Promise<Relief>;

export interface PictureOptions {
  width?: number;
  height?: number;
  yawDeg?: number;
  pitchDeg?: number;
  zoom?: number;
  material?: string;
  fine?: boolean;
}

export declare class Frame {
  private constructor();
  readonly heightMm: number;
  readonly isHeightMet: boolean;
  readonly u: number;
  readonly heights: Float32Array;
  release(): void;
}

/** Options that replace those of Session.open(). Null takes one back. */
export type SessionOptions = { [Name in keyof ReliefOptions]: ReliefOptions[Name] | null };

export declare class Session {
  private constructor();
  static open(source: Source, options?: MakeOptions): Promise<Session>;
  readonly pointCount: number;
  readonly triangleCount: number;
  frame(options?: SessionOptions): Frame;
  picture(frame: Frame, options?: PictureOptions): { width: number; height: number; pixels: Uint8ClampedArray };
  make(options?: SessionOptions & Watching): Relief;
  readonly points: Float64Array;
  readonly triangles: Uint32Array;
}

export declare function sample(name: string, options?: { points?: number; noise?: number }): Promise<Uint8Array>;

export declare class RelievoError extends Error {
  constructor(fields: { kind: string; input?: string; place?: string; expected?: string; message?: string });
  readonly kind: "input" | "option" | "geometry" | "cancelled" | "output" | "memory" | "failure";
  /** The file or the option that caused the error. */
  readonly input: string;
  /** The position in the file, such as "line 12". */
  readonly place: string;
  readonly expected: string;
}

export interface Option {
  name: string;
  keyword: string;
  unit: string;
  help: string;
  default_text: string;
  default?: unknown;
  min?: number;
  max?: number;
  choices?: string[];
}

export declare const optionTable: readonly Option[];
export declare const samples: readonly { name: string; description: string }[];
export declare const version: string;
