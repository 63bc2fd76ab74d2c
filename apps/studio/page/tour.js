// Shows the tour: five steps that explain the parts of the page. The text of a step does not cover the part that it
// explains.

import {$, make} from "./controls.js";
import {offer, toast} from "./messages.js";

const STEPS = [
  {at: "#kinds", text: "Begin with what it is to become. Each picture is of your scan, and sets size and material."},
  {at: "#shape", text: "Shape the relief. The height is met exactly; the lock keeps it while you change the rest."},
  {at: "#stage", text: "Drag on the relief to move the light. A raking light shows what the hand will feel."},
  {at: ".tools", text: "Turn, cut and measure the piece, and compare it with the scan. What you see is what is made."},
  {at: "#export", text: "Export files for printing, milling or striking. All is kept; Undo goes all the way back."},
];
const OFFER_MS = 30000;
const GAP = 24, EDGE = 10;

export class Tour {
  // enter() shows the relief for the tour. It returns false if there is no relief to show.
  constructor(enter) {
    this.enter = enter;
    this.text = make("p", {"aria-live": "polite"});
    this.next = make("button", {class: "primary", onclick: () => this.show(this.step + 1)}, "Next");
    this.element = make("div", {class: "tour", role: "dialog", "aria-label": "Tour", hidden: true}, this.text,
      make("div", {class: "buttons"}, this.next,
        this.close = make("button", {class: "quiet", onclick: () => this.end()}, "Close")));
    this.element.onkeydown = (event) => {
      event.stopPropagation();
      if (event.key === "Escape") this.end();
    };
    this.takeBack = () => {};
    document.body.append(this.element);
    addEventListener("resize", () => !this.element.hidden && this.place());
  }

  // Offers the tour once per browser, when the first scan is open. takeBack() removes the offer when the user starts to
  // work.
  offer() {
    if (localStorage.getItem("toured")) return;
    localStorage.setItem("toured", "yes");
    this.takeBack = offer("New here? Five steps show what is where.", "Show me", () => this.start(), OFFER_MS);
  }

  // Starts the tour whenever the dialog closes with the value "tour".
  follow(dialog) {
    dialog.onclose = () => {
      if (dialog.returnValue === "tour") this.start();
      dialog.returnValue = ""; // Escape would leave the value unchanged
    };
  }

  start() {
    if (!this.enter()) return toast("The tour leads through a relief: open a scan or a sample first.");
    this.before = document.activeElement;
    this.show(0);
  }

  show(step) {
    if (step === STEPS.length) return this.end();
    this.step = step;
    this.text.replaceChildren(make("b", {}, `${step + 1} of ${STEPS.length}`), make("br"), STEPS[step].text);
    this.close.hidden = step + 1 === STEPS.length;
    this.next.textContent = this.close.hidden ? "Done" : "Next";
    document.querySelector(".toured")?.classList.remove("toured");
    const part = $(STEPS[step].at);
    part.closest("details")?.setAttribute("open", "");
    part.classList.add("toured");
    this.element.hidden = false;
    this.place();
    this.next.focus();
  }

  // Places the text beside the explained part if there is enough space, otherwise over the part's lower end.
  place() {
    $(STEPS[this.step].at).scrollIntoView({block: "nearest"});
    const part = $(STEPS[this.step].at).getBoundingClientRect(), own = this.element.getBoundingClientRect();
    const within = (x, most) => Math.max(EDGE, Math.min(x, most - EDGE));
    const isLeft = part.left > own.width + 2 * GAP, isAbove = part.top > own.height + 2 * GAP;
    let left = part.left + (part.width - own.width) / 2, top = part.bottom - own.height - GAP;
    if (isLeft && part.height > own.height) left = part.left - own.width - GAP;
    else if (isAbove) top = part.top - own.height - GAP;
    else if (part.bottom + own.height + GAP < innerHeight) top = part.bottom + GAP;
    this.element.style.left = `${within(left, innerWidth - own.width)}px`;
    this.element.style.top = `${within(top, innerHeight - own.height)}px`;
  }

  end() {
    this.element.hidden = true;
    document.querySelector(".toured")?.classList.remove("toured");
    this.before?.focus();
  }
}
