// Parses numbers as people type them, like parse_length() in include/relievo/core/length.h. Both are tested by the same
// cases, tests/core/lengths.json.

const MM = {mm: 1, cm: 10, in: 25.4, '"': 25.4};
const NUMBER = "(?:\\d+(?:[.,]\\d*)?|[.,]\\d+)(?:[eE][+-]?\\d+)?", WHOLE_PART = "(?:(\\d+) +(?=\\d+/))?";
const TERM = `${WHOLE_PART}${NUMBER}(?:/${NUMBER})?`;
const WHOLE = new RegExp(`^ *(?<sum>-?${TERM}(?: *[+-] *${TERM})*) *(?<unit>mm|cm|in|")? *$`);
const TERMS = new RegExp(`([+-]?) *${WHOLE_PART}(${NUMBER})(?:/(${NUMBER}))?`, "g");

// Returns NaN for texts like "1,234", in which the comma may be decimal or separate thousands. In "0,125" it is
// decimal.
function number(text) {
  const value = Number(text.replace(",", "."));
  return /^\d*[1-9]\d*,\d{3}$/.test(text) || !Number.isFinite(value) ? NaN : value;
}

// Returns the millimetres of a text such as "2,5", "4in", "1/8 in", "1 1/8in" or "3+0.5"; NaN for other texts. Lengths
// without a unit are in units of `mm` millimetres. If `mayHaveUnit` is false, returns the number of a text, which must
// have no unit.
export function parseLength(text, mayHaveUnit = true, mm = 1) {
  const {sum, unit} = text.match(WHOLE)?.groups ?? {};
  if (!sum || (unit && !mayHaveUnit)) return NaN;
  let total = 0;
  for (const [, sign, whole = "0", top, bottom = "1"] of sum.matchAll(TERMS))
    total += Number(`${sign}1`) * (Number(whole) + number(top) / number(bottom));
  const value = total * (MM[unit] ?? mm);
  return Number.isFinite(value) ? value : NaN;
}

// The unit in which the page shows lengths. Documents and the engine have millimetres.
export const shown = {unit: "mm"};

export const millimetresPerUnit = () => MM[shown.unit];

// Returns the unit of an option as the page shows it.
export const shownUnit = (unit) => (unit === "mm" ? shown.unit : unit);

const NOISE = 1e-6; // mm, more than the rounding errors of sums, which must not decide how 6.175 is rounded

// Returns a length without its unit. `decimals` is for millimetres; inches have three decimals, or four if needed.
export function lengthText(mm, decimals = 2) {
  if (shown.unit === "mm") return (mm + NOISE).toFixed(decimals);
  const text = (mm / MM.in).toFixed(4);
  return decimals <= 2 || text.endsWith("0") ? (mm / MM.in).toFixed(3) : text;
}

export const withUnit = (mm, decimals) => `${lengthText(mm, decimals)} ${shown.unit}`;

// Returns the size of a piece.
export const sizeText = (size) => `${size.map((mm) => lengthText(mm)).join(" × ")} ${shown.unit}`;

// Returns a length as text for a field, without zeros at its end.
export const shortLength = (mm) => String(Number(lengthText(mm, 4)));

// Returns the number that was typed into a field. If there is none, or it is outside the range, says what was expected
// and returns null.
export function typedNumber(text, {label, unit, min, max}, say) {
  const isLength = unit === "mm", scale = isLength ? millimetresPerUnit() : 1, value = parseLength(text, isLength,
    scale);
  if (value >= min && value <= max) return value;
  const [from, to] = [min, max].map((x) => Number((x / scale).toPrecision(4)));
  const range = `from ${from} to ${to}${unit ? ` ${shownUnit(unit)}` : ""}`;
  const examples = isLength ? "12.5 or 2,5 or 3/8in or 3+0.5" : "0.5 or 2,5 or 3/8 or 3+0.5";
  say(`${label}: expected a number ${range}, such as ${examples}, found '${text.trim()}'.`);
  return null;
}
