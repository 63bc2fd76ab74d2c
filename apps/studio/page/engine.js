// Calls the engine for the page. The requests go through a transport: transport.js sends them by HTTP to the program
// `relievo studio`; apps/web/page/transport.js, in the page that is one file, sends them to a worker.
//
// A transport has
//   traits                         {takesSeveral: whether a scan and the files to which it refers are uploaded together;
//                                  drawsMeanwhile: whether pictures are drawn while a piece is made, and while the
//                                  first view is prepared; canRemove: whether documents are stored until the user
//                                  removes them; slowMs: if pictures take longer than this, they get fewer pixels}.
//                                  The Engine has the same traits
//   call(name, request, {files, signal, onSolved}) -> {facts, body}: the body is an object, a Blob, or the bytes of a
//                                  picture; `facts` has facts about the picture; the request is optional. onSolved
//                                  is called when the heights of a picture are solved, if the heights of the next
//                                  picture can be solved while this picture is drawn
//   addressOf(file)             -> the address of one of the page's pictures
//   follow(onStatus, onLost, say)  calls onStatus(status) for each new status of an open document, in all tabs; calls
//                                  onStatus({run}) when it finds an engine; calls onLost() when the engine is lost; and
//                                  calls say(text) with a message for the user
// and throws EngineError with a text for the user.

// `input` names the option or the file that caused the error. The text begins with that name.
export class EngineError extends Error {
  constructor({kind, text, input = ""}) {
    super(text);
    Object.assign(this, {kind, input});
  }
}

export const CANCELLED = 202; // the status of a cancelled request

export const cancelled = () => new EngineError({kind: "cancelled", text: "Cancelled."});

export const TAB = Math.random().toString(36).slice(2); // the name of this tab of the browser

export class Engine {
  document = ""; // the document to which most requests refer
  #transport;
  #making = null;

  constructor(transport) {
    Object.assign(this, transport.traits);
    this.#transport = transport;
  }

  #call = (name, request, options) => this.#transport.call(name, {document: this.document, ...request}, options);

  async #ask(name, request, options) {
    return (await this.#call(name, request, options)).body;
  }

  async #picture(name, request, options) {
    const {facts, body} = await this.#call(name, request, options);
    const pixels = new Uint8ClampedArray(body.buffer, body.byteOffset, body.length);
    return {image: new ImageData(pixels, facts.width, facts.height), facts};
  }

  #make(name, request) {
    this.#making = new AbortController();
    return this.#ask(name, request, {signal: this.#making.signal});
  }

  addressOf = (file) => this.#transport.addressOf(file);
  follow = (...listeners) => this.#transport.follow(...listeners);

  // Returns the facts for the page's start: version, options, readable, endings, formats, views, materials, stages,
  // curve, samples, recent, first (the input or project with which the program was started), notice (a message about
  // the folder in which documents are stored), most_upload (in bytes), and in some engines limits (texts for users).
  about = async () => (await this.#transport.call("about")).body;

  // Returns {document, input, is_there, kept} for a scan. `kept` is the stored state of its document, or null.
  find = (input) => this.#ask("document", {input});
  // Uploads files of the browser. Returns them as one input.
  upload = async (files) => (await this.#ask("upload", {name: files[0].name}, {files})).input;
  // Returns {input, is_there, options, usual, studio}, the content of a project file.
  readProject = (file) => this.#ask("project", {name: file.name}, {files: [file]});

  // Prepares the scan of the shown document. `view` has the options of the preparation, see viewOf().
  open = (input, view) => this.#ask("open", {input, tab: TAB, ...view});
  chooseView = (view) => this.#ask("view", view);
  cancel = () => this.#ask("cancel");

  facts = () => this.#ask("facts");
  // Returns {view, up} of each of the six sides, the best side first.
  suggestViews = async () => (await this.#ask("views")).views;

  // Return {image: ImageData, facts}. `options` has a `signal` that can cancel the picture, and the function onSolved
  // (see call() of transports).
  picture = (request, options) => this.#picture("picture", request, options);
  scan = (request) => this.#picture("scan", request);
  // Returns a picture of the depth image. Its facts state the colours of the pixels that were left out.
  pixels = () => this.#picture("pixels");

  // Returns heights in mm along a line.
  profile = async (request) => (await this.#ask("profile", request)).heights_mm;
  // Returns the points of the model under positions in its picture; null for positions beside the model. A position
  // is [x, y] from the lower left corner of the model's box, as shares of the box's width and height.
  pointsUnder = async (places) => (await this.#ask("points", {places})).points;
  // Returns {outlines, at, error} of each ornament; an outline is an array x, y, x, y ... in mm from the piece's middle.
  placeOrnaments = async (options) => (await this.#ask("ornaments", {options})).ornaments;
  // Returns the largest height, in mm, that the options allow.
  reach = async (options) => (await this.#ask("reach", {options})).height_mm;
  check = (options) => this.#ask("check", {options});

  // Returns {triangles, points, size_mm, height_mm, front_mm} of the finished piece. After that the engine has the
  // piece ready for exportFile().
  piece = (options) => this.#make("piece", {options});
  // Return a Blob: the file of a piece, or a project file that contains the scan.
  exportFile = (request) => this.#make("export", request);
  packProject = (project) => this.#ask("save", {project});

  // Stops making the piece, and cancels the request for the piece or for its file.
  cancelPiece() {
    this.#making?.abort();
    return this.#ask("cancel_piece");
  }

  // Returns {document, input, is_there, thumbnail} of the most recently changed documents, or of those that follow the
  // document `after`.
  recent = async (after = "") => (await this.#ask("recent", {after})).recent;
  // Returns {documents, bytes}: the number of stored documents and the size of all that is stored.
  kept = () => this.#ask("kept");
  remove = (document) => this.#ask("remove", {document, tab: TAB});
  keep = (document, state, isMoving) => this.#ask("state", {document, state, tab: TAB, is_moving: isMoving});
  keepThumbnail = (document, thumbnail) => this.#ask("thumbnail", {document, thumbnail});
  // Reports that the user leaves the page. Ignores errors.
  leave = () => this.#ask("leave", {tab: TAB}).catch(() => {});
}
