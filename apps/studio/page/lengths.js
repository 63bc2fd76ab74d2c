// Numbers as people type them: the twin of parse_length() in include/relievo/core/length.h, tested by the same cases,
// tests/core/lengths.json.

const MM = {mm: 1, cm: 10, in: 25.4, '"': 25.4};
const NUMBER = "(?:\\d+(?:[.,]\\d*)?|[.,]\\d+)(?:[eE][+-]?\\d+)?", TERM = `${NUMBER}(?:/${NUMBER})?`;
const WHOLE = new RegExp(`^ *(-?${TERM}(?: *[+-] *${TERM})*) *(mm|cm|in|")? *$`);
const TERMS = new RegExp(`([+-]?) *(${NUMBER})(?:/(${NUMBER}))?`, "g");

// Nobody can tell whether "1,234" has a decimal comma or a thousand; "0,125" has a comma.
function number(text) {
  const value = Number(text.replace(",", "."));
  return /^\d*[1-9]\d*,\d{3}$/.test(text) || !Number.isFinite(value) ? NaN : value;
}

// Returns the millimetres of "2,5", "4in", "1/8 in" or "3+0.5", or the number of a text that may have no unit; NaN of
// any other text.
export function parseLength(text, mayHaveUnit = true) {
  const [, sum, unit] = text.match(WHOLE) ?? [];
  if (!sum || (unit && !mayHaveUnit)) return NaN;
  let total = 0;
  for (const [, sign, top, bottom = "1"] of sum.matchAll(TERMS))
    total += Number(`${sign}1`) * number(top) / number(bottom);
  const value = total * (MM[unit] ?? 1);
  return Number.isFinite(value) ? value : NaN;
}

// Returns the number that was typed into a field; null if there is none in its range, after saying what was expected.
export function typedNumber(text, {label, unit, min, max}, say) {
  const value = parseLength(text, unit === "mm"), range = `from ${min} to ${max}${unit ? ` ${unit}` : ""}`;
  if (value >= min && value <= max) return value;
  const examples = unit === "mm" ? "12.5, 2,5, 3/8in or 3+0.5" : "0.5, 2,5, 3/8 or 3+0.5";
  say(`${label}: expected a number ${range}, such as ${examples}, found '${text.trim()}'.`);
  return null;
}
