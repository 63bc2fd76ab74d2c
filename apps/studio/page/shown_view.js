// Keeps the view of the shown model, and waits for a requested view. When no request is left, document, engine and
// picture have the same view, even after requests of other pages, and after cancelled or refused requests.

import {isSameView, optionsOf, viewOf} from "./opening.js";

export class ShownView {
  // Calls showDocument() when it has changed the document, and failed(error) when a request fails.
  constructor({doc, stage, opened, showDocument, failed}) {
    Object.assign(this, {doc, stage, opened, showDocument, failed});
    this.clear();
  }

  // Begins another document, which has no model yet.
  clear() {
    this.view = null; // the view that was shown last while no other was requested
  }

  // Requests the document's view.
  choose() {
    return this.opened.chooseView().catch((error) => {
      if (error.kind === "option" && !this.opened.asked) this.restore();
      this.failed(error); // shows the error until the next change
    });
  }

  // Waits for the view of a state that another page has kept. This is needed even if the model has this view, as
  // another view may have been requested meanwhile.
  adopt() {
    const {view, stage, opened} = this;
    if (!view || (!stage.isAwaiting && isSameView(view, opened.wantedView(view)))) return;
    stage.await(true);
    opened.ensureView().catch(this.failed);
  }

  // Call this when a model is shown, with the status that announced it. The engine may have sent newer statuses since.
  arrived(status) {
    const newest = this.opened.status;
    if (!status.busy && !status.error) this.view ??= status.shown;
    this.settle(newest);
    if (newest.error && !newest.busy) this.restore();
  }

  // Ends the wait when the model has the view that this or another page requested last.
  settle({busy, error, shown}) {
    if (busy || error || this.opened.asked) return;
    this.view = shown;
    if (!isSameView(shown, viewOf(this.doc.now))) {
      this.doc.note({options: optionsOf(shown, this.doc.now)});
      this.showDocument();
    }
    if (this.stage.isAwaiting) this.stage.await(false);
  }

  // Returns to the former view if another one was cancelled or could not be prepared.
  restore() {
    const former = this.view ?? this.opened.status.shown;
    this.stage.await(false);
    const {now} = this.doc;
    if (former?.view && !isSameView(former, viewOf(now))) this.doc.change({options: optionsOf(former, now)});
  }
}
