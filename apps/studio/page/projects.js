// Opens project files, asks for missing scans, and saves project files with or without the scan.

import {about} from "./about.js";
import {$, download, fileSize, make} from "./controls.js";
import {projectOf, stepOfProject} from "./document.js";
import {offer, toast} from "./messages.js";
import {plainName} from "./panels/kinds.js";
import {filesIn} from "./ornament_list.js";
import {sceneFile} from "./panels/scene_panel.js";
import {zipOf} from "./zip.js";

// Returns whether one of the files is a scan or a scene that can refer to other files.
const refersToOthers = (files) => files.some(({name}) => /\.(gltf|json)$/i.test(name));

// Returns one file that contains a .gltf and all files to which the .gltf refers.
async function together(files) {
  const gltf = files.find(({name}) => /\.gltf$/i.test(name));
  if (!gltf) throw new Error("Several files at once: expected scans, or a .gltf with the files that it names.");
  const size = files.reduce((sum, file) => sum + file.size, 0), most = about.most_upload;
  if (size > most)
    throw new Error(`${gltf.name} and its files have ${fileSize(size)}: expected at most ${fileSize(most)}.`);
  return zipOf(files, gltf.name.replace(/gltf$/i, "zip"));
}

// Converts a JPEG or WebP picture, which browsers can read and the engine cannot, to a PNG. Returns other files
// unchanged.
async function readable(file) {
  if (!/\.(jpe?g|webp)$/i.test(file.name)) return file;
  const image = await createImageBitmap(file).catch(() => null);
  if (!image) return file; // the engine will report what it expects
  const canvas = make("canvas", {width: image.width, height: image.height});
  canvas.getContext("2d").drawImage(image, 0, 0);
  const content = await new Promise((resolve) => canvas.toBlob(resolve));
  return new File([content], file.name.replace(/\w+$/, "png"));
}

export class Projects {
  // `open(input, work)` shows a document, see OpenDocument. `take(promise)` shows that an upload or download is
  // running. `rest()` shows the page when nothing is opened.
  constructor({engine, open, take, rest, failed}) {
    Object.assign(this, {engine, open, take, rest, failed});
    $("#locate").onchange = (event) => {
      const [file] = event.target.files;
      event.target.value = "";
      if (file) this.located(file).catch(failed);
    };
  }

  // Opens files that the user dropped or chose: a project, a scan in one or several files, or several scans as a scene.
  async openFiles(files) {
    if (!files.length) return null;
    const most = about.most_upload, tooLarge = files.find(({size}) => size > most);
    if (tooLarge)
      throw new Error(`${tooLarge.name} has ${fileSize(tooLarge.size)}: expected at most ${fileSize(most)}.`);
    if (files.length === 1 && files[0].name.endsWith(".relievo"))
      return this.openProject(await this.take(this.engine.readProject(files[0])));
    if (files.length === 1) return this.openScan([await readable(files[0])]);
    if (refersToOthers(files) || this.engine.takesSeveral) return this.openScan(files);
    if (files.some(({name}) => /\.(relievo|zip)$/i.test(name)))
      throw new Error("Several files at once: expected scans alone, to be put side by side.");
    const models = [];
    for (const file of files) models.push({file: (await this.take(this.engine.upload([file]))).path});
    return this.openScene(models);
  }

  async openScan(files, work = null) {
    const upload = files.length > 1 && !this.engine.takesSeveral
      ? together(files).then((file) => this.engine.upload([file])) : this.engine.upload(files);
    return this.open(await this.take(upload), work);
  }

  openScene = (models, work = null) => this.openScan([sceneFile(models)], work);

  async openProject(project) {
    const work = {steps: [stepOfProject(project)], at: 0};
    if (project.is_there) return this.open(project.input, work);
    this.askFor(project.input, work);
  }

  // Asks the user where a missing scan is.
  askFor(input, work) {
    this.wanted = {input, work};
    this.rest();
    const {name, path, hash = ""} = input, digits = hash.slice(hash.indexOf(":") + 1);
    const place = digits && path.includes(`/scans/${digits}/`) ? "among the scans that were dropped" : `at ${path}`;
    offer(`${name} is not found ${place}.`, "Locate it", () => $("#locate").click());
  }

  async located(file) {
    const {input: {name, hash}, work} = this.wanted, input = await this.take(this.engine.upload([file]));
    if (!hash || input.hash === hash) return this.open(input, work);
    this.rest();
    offer(`${file.name} is not ${name} as it was when this work was kept.`, "Use it all the same",
      () => this.open(input, work), Infinity, [["Locate another file", () => $("#locate").click()]]);
  }

  // Saves a step as a project file; the promise `promised` resolves to the step. First asks whether to include the scan,
  // if that is possible. A sample is never included, but the fonts and drawings of its ornaments are.
  save(input, promised) {
    const name = plainName(input), saveStep = async (isWithScan) => {
      try {
        const project = projectOf(await promised);
        const text = JSON.stringify(project, null, 1) + "\n";
        const isPacked = isWithScan || (input.sample && filesIn(project.options).length > 0);
        download(isPacked ? await this.take(this.engine.packProject(project))
          : new Blob([text], {type: "application/json"}), `${name}.relievo`);
        toast(`Saved: ${name}.relievo.`);
      } catch (error) {
        this.failed(error);
      }
    };
    if (input.sample || /\.json$/i.test(input.path)) return saveStep(false);
    const dialog = $("#save-dialog");
    dialog.onclose = () => dialog.returnValue === "save" && saveStep($("#with-scan").checked);
    dialog.returnValue = "cancel";
    dialog.showModal();
  }
}
