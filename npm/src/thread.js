// Runs in the worker of RelievoWorker. Answers each message by calling a function of the package.
import { make, sample } from "./index.js";

const errorFields = ({ name, message, kind, input, place, expected }) => ({ name, message, kind, input, place, expected });

const jobs = {
  async make({ source, options, results }, report) {
    const relief = await make(source, { ...options, progress: report });
    const files = {};
    for (const format of results.solids ?? ["stl"]) files[format] = relief.solid(format);
    return { report: relief.report, remarks: relief.remarks, solids: files,
      heightMap: results.heightMap ? relief.heightMap(results.heightMap) : null,
      preview: results.preview ? relief.preview(results.preview) : null };
  },
  sample: ({ name, options }) => sample(name, options),
};

// `post` sends a message to the page.
export async function answer({ id, job, ...request }, post) {
  try {
    const value = await jobs[job](request, (stage, fraction) => post({ id, stage, fraction }));
    post({ id, value });
  } catch (error) {
    post({ id, error: errorFields(error) });
  }
}
