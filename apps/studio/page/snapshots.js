// Snapshots are settings that the user has named: all of a step of the document except its scan. A step has the list of
// those that were taken so far, and of a snapshot's options those that a new document does not have.

import {FIRST, studioPart} from "./document.js";
import {packed, unpacked} from "./strokes.js";

export const MOST_SNAPSHOTS = 50;

export function snapshotOf({input: _input, snapshots: _snapshots, options: all, ...rest}, name) {
  const options = Object.fromEntries(Object.entries(all).filter(([key, value]) =>
    JSON.stringify(value) !== JSON.stringify(FIRST.options[key])));
  return {name, ...rest, options};
}

// Returns the change of a step to the settings of a snapshot.
export const partOfSnapshot = ({name: _name, options, ...rest}) =>
  ({...rest, options: {...FIRST.options, ...options}});

// Returns "Snapshot 3" if that is the first name of this kind that no snapshot has.
export function freeName(snapshots) {
  const names = new Set(snapshots.map(({name}) => name));
  let number = snapshots.length + 1;
  while (names.has(`Snapshot ${number}`)) ++number;
  return `Snapshot ${number}`;
}

// Returns the snapshots of a project file. Leaves out what is none, options that this version does not know, and values
// of another type.
export function snapshotsIn(list) {
  const isLike = (value, known) => value === null || known === null || typeof value === typeof known;
  const isSnapshot = (each) => typeof each?.name === "string" && each.options && typeof each.options === "object";
  return (Array.isArray(list) ? list : []).filter(isSnapshot).slice(0, MOST_SNAPSHOTS).map(({name, options, ...own}) =>
    snapshotOf({...FIRST, ...studioPart(own), options: Object.fromEntries(Object.entries(options).filter(
      ([key, value]) => key in FIRST.options && typeof value !== "object" && isLike(value, FIRST.options[key])))},
    name.slice(0, 80)));
}

// Steps of a document share their lists of snapshots, lists share snapshots, and all share strokes. Returns steps that
// have the number of their list, with the lists of numbers of snapshots, and the snapshots.
export function packedSteps(steps) {
  const lists = [...new Set(steps.map(({snapshots}) => snapshots))], all = [...new Set(lists.flat())];
  const {steps: each, ...strokes} = packed([...steps, ...all]);
  if (all.length === 0) return {steps: each.map(({snapshots: _, ...step}) => step), ...strokes};
  return {steps: each.slice(0, steps.length).map((step) => ({...step, snapshots: lists.indexOf(step.snapshots)})),
    lists: lists.map((list) => list.map((snapshot) => all.indexOf(snapshot))), snapshots: each.slice(steps.length),
    ...strokes};
}

// Returns the steps that were packed. Those of a project file were not, and stay as they are.
export function unpackedSteps({steps, lists = [], snapshots = [], strokes}) {
  const whole = (step) => ({...step, options: unpacked(step.options ?? {}, strokes)});
  const all = snapshots.map(whole), taken = lists.map((list) => list.map((number) => all[number]).filter(Boolean));
  const listOf = ({snapshots: own}) => (Array.isArray(own) ? own : taken[own] ?? FIRST.snapshots);
  return steps.map((step) => ({...whole(step), snapshots: listOf(step)}));
}
