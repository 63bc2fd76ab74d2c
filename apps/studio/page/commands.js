// Connects the page's buttons and keys to their commands.

import {about} from "./about.js";
import {$} from "./controls.js";
import {keepPanels, takeDrops, takeKeys} from "./inputs.js";

const TOOL_KEYS = {l: "light", r: "turn", o: "orbit", h: "pan", p: "place", s: "section", m: "measure", x: "crop",
  d: "brush"};

// Connects the parts of the page. `own` has functions of the page: isThere(), which returns whether there is a relief,
// save(), which saves a project, openFiles(files), showStart(isShown), chooseUnit(unit) and failed(error).
export function takeCommands({doc, stage, entries, exporting, views, modes, cropFrame, brush, opened, tour, ...own}) {
  const help = $("#help-dialog"), showHelp = () => help.showModal(), choose = () => $("#file").click();
  const undo = () => entries.undo(), redo = () => entries.redo(), makeFiles = () => exporting.open();
  const chooseView = () => views.show(doc.now.options);
  const buttons = {
    undo, redo, open: choose, drop: choose, save: own.save, export: makeFiles, help: showHelp,
    home: () => own.showStart(true), back: () => own.showStart(false), cancel: () => opened.cancel().catch(own.failed),
    "choose-view": chooseView,
  };
  for (const [id, act] of Object.entries(buttons)) $(`#${id}`).onclick = act;
  $("#file").onchange = ({target}) => {
    own.openFiles([...target.files]);
    target.value = "";
  };
  $("#unit").onchange = ({target}) => own.chooseUnit(target.value);
  keepPanels(document.querySelectorAll(".inspector details"), localStorage);
  tour.follow(help);
  takeDrops($("#veil"), own.openFiles);

  const isShown = () => !$("#studio").hidden, isReady = () => own.isThere() && isShown();
  const ofDocument = (act, may = isShown) => () => may() && act(); // keys must not change a hidden document
  const commands = {z: ofDocument(undo), Z: ofDocument(redo), y: ofDocument(redo), s: ofDocument(own.save, isReady),
    e: ofDocument(makeFiles, isReady), o: choose};
  const keys = {
    f: () => stage.fit(), t: () => modes.toggleTable(), c: () => modes.toggleComparing(), v: chooseView,
    "[": () => brush.resize(-1), "]": () => brush.resize(1),
    Escape: () => cropFrame.giveUp() || stage.takeBack() || modes.leave(),
    ...Object.fromEntries(Object.entries(TOOL_KEYS).map(([key, tool]) => [key, () => modes.setTool(tool)])),
    ...Object.fromEntries(about.materials.map(({id}, i) => [i + 1, () => doc.change({material: id})])),
  };
  takeKeys({commands, always: {"?": showHelp}, keys, isReady, hold: (isHolding) => stage.comparing.set({isHolding})});
}
