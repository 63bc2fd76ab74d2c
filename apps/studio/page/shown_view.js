// Keeps the view of the shown model while another view is requested. When no request is left, the document, the engine
// and the picture have the same view. This holds even if other tabs have requested views, or if requests were cancelled
// or refused.

import {isSameView, optionsOf, viewOf} from "./opening.js";

export class ShownView {
  // Calls showDocument() after it has changed the document, and failed(error) when a request fails.
  constructor({doc, stage, opened, showDocument, failed}) {
    Object.assign(this, {doc, stage, opened, showDocument, failed});
    this.clear();
  }

  // Prepares for another document, which has no model yet.
  clear() {
    this.view = null; // the last view that was shown while no other view was requested
  }

  // Requests the preparation of the document's view.
  choose() {
    return this.opened.chooseView().catch((error) => {
      if (error.kind === "option" && !this.opened.asked) this.restore();
      this.failed(error); // shows the error until the next change
    });
  }

  // Waits for the view of a state that another tab has stored. The model may have this view already. Even then the wait
  // is needed while another view is being prepared.
  adopt() {
    const {view, stage, opened} = this;
    if (!view || (!stage.isAwaiting && isSameView(view, opened.wantedView(view)))) return;
    stage.await(true);
    opened.ensureView().catch(this.failed);
  }

  // Must be called when a model is shown, with the status that announced the model. The engine may have sent newer
  // statuses since.
  arrived(status) {
    const newest = this.opened.status;
    if (!status.busy && !status.error) this.view ??= status.requested;
    this.settle(newest);
    if (newest.error && !newest.busy) this.restore();
  }

  // Ends the wait when the model has the view that was requested last, in whichever tab.
  settle({busy, error, requested}) {
    if (busy || error || this.opened.asked) return;
    this.view = requested;
    if (!isSameView(requested, viewOf(this.doc.now))) {
      this.doc.note({options: optionsOf(requested, this.doc.now)});
      this.showDocument();
    }
    if (this.stage.isAwaiting) this.stage.await(false);
  }

  // Restores the former view after another one was cancelled or could not be prepared.
  restore() {
    const former = this.view ?? this.opened.status.requested;
    this.stage.await(false);
    const {now} = this.doc;
    if (former?.view && !isSameView(former, viewOf(now))) this.doc.change({options: optionsOf(former, now)});
  }
}
