// Sets the modes of the picture: the tool, the light table, the comparison and the material.

import {about} from "./about.js";
import {$, check, make, pair} from "./controls.js";
import {takeArrowKeys} from "./inputs.js";
import {TABLE_LIGHTS} from "./lights.js";
import {partOfSnapshot} from "./snapshots.js";

const isPressed = (selector) => $(selector).getAttribute("aria-pressed") === "true";

export class Modes {
  // Calls compared() when the comparison changes.
  constructor({stage, doc, cropFrame, sliders, compared}) {
    Object.assign(this, {stage, doc, cropFrame, compared, rival: null}); // rival: the snapshot that is compared
    this.attention = make("input", {type: "checkbox", onchange: () => this.showAttention(this.attention.checked)});
    sliders.attention.append(pair("Show it on the model", this.attention,
      {title: "Compares the relief with the model, which is orange where viewers are guessed to look"}));
    $("#materials").append(...about.materials.map(({id, name}) => make("button", {
      role: "radio", "data-material": id, "aria-label": name, title: name, onclick: () => doc.change({material: id}),
    })));
    $("#table").append(...TABLE_LIGHTS.map(({name, light}, i) => make("button", {
      "data-cell": i, "aria-label": `Light from: ${name}`, onclick: () => {
        doc.change({light});
        this.setTable(false);
      },
    }, make("canvas", {"aria-hidden": "true"}), make("span", {"aria-hidden": "true"}, name))));
    for (const button of $("#tools").children) button.onclick = () => this.setTool(button.dataset.tool);
    takeArrowKeys($("#tools"));
    takeArrowKeys($("#materials"));
    $("#light-table").onclick = () => this.toggleTable();
    $("#compare").onclick = () => this.toggleComparing();
    $("#fit").onclick = () => stage.fit();
    $("#split").oninput = (event) => stage.comparing.setSplit(event.target.value / 1000);
    this.setTool("light");
  }

  setTool(tool) {
    for (const button of $("#tools").children) check(button, button.dataset.tool === tool);
    $("#section").hidden = tool !== "section";
    $("#place-hint").hidden = tool !== "place";
    $("#brush").hidden = tool !== "brush";
    this.cropFrame.show(tool === "crop");
    if (tool !== "light") this.setTable(false);
    this.stage.setTool(tool);
  }

  setTable(isShown) {
    $("#light-table").setAttribute("aria-pressed", isShown);
    $("#table").hidden = !isShown;
    this.stage.setTable(isShown);
  }

  toggleTable = () => this.setTable(!isPressed("#light-table"));

  // Starts or ends a comparison. During a comparison, the left side of a divider shows the relief of the snapshot
  // `rival`, or the model if `rival` is null.
  setComparing(isComparing, rival = null) {
    if (isComparing === isPressed("#compare") && rival === this.rival) return;
    this.rival = rival;
    $("#compare").setAttribute("aria-pressed", isComparing);
    $("#split").hidden = $("#labels").hidden = !isComparing;
    const names = rival ? [rival.name, "Now"] : ["Model", "Relief"];
    for (const [i, label] of [...$("#labels").children].entries()) label.textContent = names[i];
    $("#split").setAttribute("aria-label", `Divider between ${rival ? names.join(" and ") : "model and relief"}`);
    this.attention.checked &&= isComparing && !rival;
    const hasAttention = this.attention.checked;
    this.stage.comparing.set({isComparing, hasAttention, rival: rival && partOfSnapshot(rival)});
    this.compared();
  }

  // If `isShown` is true, shows the model, coloured by its attention, beside the relief. Otherwise ends this
  // comparison.
  showAttention(isShown) {
    this.stage.comparing.set({hasAttention: isShown});
    this.setComparing(isShown);
  }

  toggleComparing = () => this.setComparing(!isPressed("#compare"));

  leave() {
    this.setTable(false);
    this.setComparing(false);
  }

  showMaterial(material) {
    for (const swatch of $("#materials").children) check(swatch, swatch.dataset.material === material);
  }
}
