// Opens the document of a scan or a project, and shows it on this page. Follows the status of the document, and takes
// over its state after another engine or another tab has changed it.

import {namesOf} from "./about.js";
import {FIRST} from "./document.js";
import {TAB} from "./engine.js";
import {engineBack, toast} from "./messages.js";
import {inWords} from "./panels/pieces.js";
import {unpackedSteps} from "./snapshots.js";

const PREPARED = namesOf("input", "view", "model");

// Returns whether the scan is a photo whose brightness becomes the thickness of a lithophane. The engine then prepares
// the brightness instead of heights.
const isPhoto = ({input, options: {form, "depth-values": values}}) => form === "lithophane" &&
  ["auto", "luminance"].includes(values) && /\.(png|tiff?|bmp|ppm|pgm)$/i.test(input?.name ?? "");

// Returns the options that determine the model that the engine prepares.
export const viewOf = (step) => ({...Object.fromEntries(PREPARED.map((name) => [name, step.options[name]])),
  form: isPhoto(step) ? "lithophane" : "relief"});

// Returns the options that give a document a view. Leaves out the form if the document's own view has the same form.
// The forms can differ only for photos.
export const optionsOf = ({form, ...options}, now) => (form === viewOf(now).form ? options : {...options, form});

export const isSameView = (a, b) => Object.keys(a).every((name) => a[name] === b[name]);

const withSide = (wanted, {view, up}) => (wanted.view === "auto" ? {...wanted, view, up} : wanted);

const withInput = ({steps, at}, input) => ({version: 1, changed: 0, steps: steps.map((step) => ({...step, input})),
  at});

// Returns the `work` of a stored state, see OpenDocument.open(); null if there is no state.
const workOf = (kept) => (kept ? {steps: unpackedSteps(kept), at: kept.at} : null);

export class OpenDocument {
  // Calls these functions of `on`:
  //   begun(former)         when another document is shown; `former` is the input of the former document, or null
  //   progress(status)      for each new status of the document
  //   measured(status)      when pictures of the first view can be drawn although this view is not yet prepared
  //   arrived(status)       when the model is ready
  //   changed()             when a newer state came from another tab or engine
  //   missing(input, work)  if the scan is missing
  //   refused(why)          if the view cannot be prepared; `why` is "" if the user cancelled the preparation
  //   failed(error)         after any other error
  //   closed()              when no document is left to show
  constructor({engine, doc, keeper, on}) {
    Object.assign(this, {engine, doc, keeper, on, id: "", status: {busy: false, model: 0}, model: 0, run: ""});
    this.asked = null; // the view that this page requested last; null once the engine has reported it
    this.statuses = new Map(); // statuses of all open documents
  }

  get input() {
    return this.doc.now.input;
  }

  get isReady() {
    return this.model > 0;
  }

  // Shows the document of a scan. `work` is {steps, at} of a project, or of a document whose scan has moved. If no
  // state of the document is stored, the document gets all steps of `work`. Otherwise only the step `at` is added to
  // the stored steps. If the scan's file is missing and the engine uses another file with the same bytes, `moved` has
  // the work on the missing file. `moved` is used like `work`, but its step is not added if the document has that step.
  async open(input, work = null) {
    const found = await this.engine.find(input), moved = workOf(found.moved);
    if (!found.is_there) return this.on.missing(found.input, work ?? workOf(found.kept));
    const former = this.isReady && this.id !== found.document ? this.input : null;
    const copy = this.keeper.copyOf(found.document), {kept} = found;
    const newest = copy && copy.changed > (kept?.changed ?? -1) ? copy : kept;
    this.former = former;
    this.id = this.engine.document = found.document;
    this.takeState(newest, found.input, work, moved);
    if (work || moved || (copy && newest === copy)) this.keep(); // a new document is stored after its scan was read
    this.isKept = Boolean(newest);
    this.model = 0;
    this.asked = null;
    this.status = {busy: true, model: 0, stage: "waiting"};
    history.replaceState(null, "", `#${this.id}`);
    this.on.begun(former);
    await this.openInEngine(found.input);
  }

  // Opens the shown document in the engine. The status of the document may arrive before this call ends.
  async openInEngine(input) {
    const {id} = this, isOpen = this.engine.open(input, viewOf(this.doc.now));
    this.isOpen = isOpen.catch(() => {}); // the caller gets the error from the next line
    await isOpen;
    const status = this.statuses.get(id);
    if (status && this.id === id) this.take(status);
  }

  // Requests the document's view. First waits until the engine has opened the document, because the engine would refuse
  // an earlier request.
  async chooseView() {
    const {id} = this;
    this.asked = viewOf(this.doc.now);
    await this.isOpen;
    if (this.id !== id) return;
    const view = (this.asked = viewOf(this.doc.now));
    await this.engine.chooseView(view).catch((error) => {
      if (this.asked === view) this.asked = null;
      throw error;
    });
  }

  // Requests the document's view, unless it was requested before.
  async ensureView() {
    this.asked = viewOf(this.doc.now);
    await this.openInEngine(this.input);
  }

  async cancel() {
    await this.isOpen;
    await this.engine.cancel();
  }

  takeState(newest, input, work, moved) {
    const {doc} = this, other = work ?? moved;
    if (newest && doc.restore(newest)) {
      if (other && (work || !doc.has(other.steps[other.at]))) doc.append({...other.steps[other.at], input});
    } else if (!(other && doc.restore(withInput(other, input)))) doc.begin({...FIRST, input});
  }

  keep(isMoving = false) {
    if (this.id) this.keeper.keep(this.id, this.doc.keep(), isMoving);
  }

  // ------------------------------------------------------------------------------------------- the engine's news

  followed(status) {
    const isOtherRun = status.run !== this.run, isFirst = this.run === "";
    if (isOtherRun) this.statuses.clear();
    this.run = status.run;
    engineBack();
    if (isOtherRun && !isFirst) this.resume().catch(this.on.failed);
    if (!status.document) return this.keeper.retry();
    this.statuses.set(status.document, status);
    if (status.document === this.id) this.take(status);
  }

  take(status) {
    const before = this.status;
    this.status = status;
    if (this.asked && isSameView(withSide(this.asked, status.requested), status.requested)) this.asked = null;
    this.on.progress(status);
    if (!this.isReady && status.busy && status.can_turn && status.requested.view !== "auto") this.on.measured(status);
    if (status.model > 0 && status.model !== this.model && this.isWanted(status)) this.arrive(status);
    else if (status.error && JSON.stringify(status.error) !== JSON.stringify(before.error)) this.complain(status);
    if (status.kept.changed > this.doc.changedAt && status.kept.tab !== TAB) this.adopt().catch(this.on.failed);
  }

  // Returns the view of the document, with the side that the engine chose if the document leaves it open.
  wantedView = (requested) => withSide(viewOf(this.doc.now), requested);

  // Returns whether the model may be shown. The first model of a document must have the document's view, unless the
  // preparation of a view has failed.
  isWanted({busy, error, requested}) {
    return this.model > 0 || (!busy && (error || isSameView(requested, this.wantedView(requested))));
  }

  arrive(status) {
    this.model = status.model;
    const {hash: known} = this.input, {hash} = status.input;
    if (hash !== known) this.doc.note({input: status.input});
    if (known && hash !== known)
      toast(`${status.input.name} has changed since you worked on it: your settings are applied to it as it is now.`,
        true);
    if (!this.isKept || hash !== known) this.keep();
    this.isKept = true;
    this.on.arrived(status);
  }

  complain({error, model}) {
    const {path, name} = this.input; // users know a dropped scan by its name, not by its path in the engine's storage
    const message = path ? error.text.replaceAll(path, () => name) : error.text;
    const why = error.kind === "cancelled" ? "" : inWords({input: error.input, message});
    if (model > 0 && !(this.asked && why)) return this.on.refused(why);
    if (why) toast(why);
    if (model > 0) return; // another view is already being prepared
    const {former} = this;
    this.former = null;
    this.id = this.engine.document = "";
    if (!former) return this.on.closed();
    this.open(former).catch(this.on.failed);
  }

  // Takes over the stored state of this document if it is newer than the shown one. Returns whether it was taken over.
  async adopt() {
    const {id} = this, {kept} = await this.engine.find(this.input);
    if (id !== this.id || !(kept?.changed > this.doc.changedAt) || !this.doc.restore(kept)) return false;
    this.on.changed();
    return true;
  }

  // Must be called when another engine has replaced the former one. If the new engine has a newer state of the document
  // than the shown state, shows the newer one. Opens the document again.
  async resume() {
    if (!this.id) return;
    if (await this.adopt()) toast("The engine is back. It had newer work on this scan, which is shown here.");
    else {
      this.keep();
      toast("The engine is back, and goes on with what this page shows.");
    }
    await this.reopen();
  }

  // Opens the document again. Must be called when the engine has closed it. Forgets the document's last status, which
  // is no longer valid.
  async closed() {
    this.statuses.delete(this.id);
    await this.reopen();
  }

  async reopen() {
    this.model = 0;
    await this.openInEngine(this.input);
  }
}
