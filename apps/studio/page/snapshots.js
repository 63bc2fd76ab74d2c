// Makes and packs snapshots: settings that the user has named. A snapshot contains all parts of a document's step
// except the scan and the list of snapshots. Of the options, it contains only those that differ from a new document.

import {FIRST, studioPart} from "./document.js";
import {packed, unpacked} from "./strokes.js";

export const MOST_SNAPSHOTS = 50;

export function snapshotOf({input: _input, snapshots: _snapshots, options: all, ...rest}, name) {
  const options = Object.fromEntries(Object.entries(all).filter(([key, value]) =>
    JSON.stringify(value) !== JSON.stringify(FIRST.options[key])));
  return {name, ...rest, options};
}

// Returns the changes that give a step the settings of a snapshot.
export const partOfSnapshot = ({name: _name, options, ...rest}) =>
  ({...rest, options: {...FIRST.options, ...options}});

// Returns a name that no snapshot has, such as "Snapshot 3". Its number is greater than the number of snapshots.
export function freeName(snapshots) {
  const names = new Set(snapshots.map(({name}) => name));
  let number = snapshots.length + 1;
  while (names.has(`Snapshot ${number}`)) ++number;
  return `Snapshot ${number}`;
}

// Returns the options of a project file without those that this version does not know, or whose value has a wrong type.
export function knownOptions(options) {
  const isLike = (value, known) =>
    value === null || (typeof value !== "object" && (known === null || typeof value === typeof known));
  return Object.fromEntries(Object.entries(options ?? {}).filter(([key, value]) =>
    key in FIRST.options && isLike(value, FIRST.options[key])));
}

// Returns the valid snapshots of a project file.
export function snapshotsIn(list) {
  const isSnapshot = (each) => typeof each?.name === "string" && each.options && typeof each.options === "object";
  return (Array.isArray(list) ? list : []).filter(isSnapshot).slice(0, MOST_SNAPSHOTS).map(({name, options, ...own}) =>
    snapshotOf({...FIRST, ...studioPart(own), options: knownOptions(options)}, name.slice(0, 80)));
}

// Packs steps so that what they share is stored only once: lists of snapshots, snapshots, and strokes. In the result,
// a step has the index of its list in `lists`, and a list has indices into `snapshots`.
export function packedSteps(steps) {
  const lists = [...new Set(steps.map(({snapshots}) => snapshots))], all = [...new Set(lists.flat())];
  const {steps: each, ...strokes} = packed([...steps, ...all]);
  if (all.length === 0) return {steps: each.map(({snapshots: _, ...step}) => step), ...strokes};
  return {steps: each.slice(0, steps.length).map((step) => ({...step, snapshots: lists.indexOf(step.snapshots)})),
    lists: lists.map((list) => list.map((snapshot) => all.indexOf(snapshot))), snapshots: each.slice(steps.length),
    ...strokes};
}

// Unpacks the steps that packedSteps() packed. The steps of a project file are not packed, and stay as they are.
export function unpackedSteps({steps, lists = [], snapshots = [], strokes}) {
  const whole = (step) => ({...step, options: unpacked(step.options ?? {}, strokes)});
  const all = snapshots.map(whole), taken = lists.map((list) => list.map((number) => all[number]).filter(Boolean));
  const listOf = ({snapshots: own}) => (Array.isArray(own) ? own : taken[own] ?? FIRST.snapshots);
  return steps.map((step) => ({...whole(step), snapshots: listOf(step)}));
}
