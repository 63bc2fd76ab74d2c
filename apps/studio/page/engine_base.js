// The base class has all that the engines of all pages share.

export class EngineError extends Error {
  constructor(kind, text) {
    super(text);
    this.kind = kind;
  }
}

export const CANCELLED = 202; // the status of an answer that was given up

export const TAB = Math.random().toString(36).slice(2); // the name of this page among those that are open
