// Parses numbers as people type them, with the same results as parse_length() in include/relievo/core/length.h. The
// cases in tests/core/lengths.json test both.

const MM = {mm: 1, cm: 10, in: 25.4, '"': 25.4};
const NUMBER = "(?:\\d+(?:[.,]\\d*)?|[.,]\\d+)(?:[eE][+-]?\\d+)?", WHOLE_PART = "(?:(\\d+) +(?=\\d+/))?";
const TERM = `${WHOLE_PART}${NUMBER}(?:/${NUMBER})?`;
const WHOLE = new RegExp(`^ *(?<sum>-?${TERM}(?: *[+-] *${TERM})*) *(?<unit>mm|cm|in|")? *$`);
const TERMS = new RegExp(`([+-]?) *${WHOLE_PART}(${NUMBER})(?:/(${NUMBER}))?`, "g");

// Returns the number in a text. Returns NaN for a text such as "1,234", whose comma may be a decimal comma or separate
// thousands. In "0,125" the comma can only be a decimal comma.
function number(text) {
  const value = Number(text.replace(",", "."));
  return /^\d*[1-9]\d*,\d{3}$/.test(text) || !Number.isFinite(value) ? NaN : value;
}

// Returns the length in a text such as "2,5", "4in", "1/8 in", "1 1/8in" or "3+0.5", in mm; NaN for other texts. A
// length without a unit is multiplied by `mm`. If `mayHaveUnit` is false, the text must be a number without a unit.
export function parseLength(text, mayHaveUnit = true, mm = 1) {
  const {sum, unit} = text.match(WHOLE)?.groups ?? {};
  if (!sum || (unit && !mayHaveUnit)) return NaN;
  let total = 0;
  for (const [, sign, whole = "0", top, bottom = "1"] of sum.matchAll(TERMS))
    total += Number(`${sign}1`) * (Number(whole) + number(top) / number(bottom));
  const value = total * (MM[unit] ?? mm);
  return Number.isFinite(value) ? value : NaN;
}

// The unit in which the page shows lengths. Documents and the engine use millimetres.
export const shown = {unit: "mm"};

export const millimetresPerUnit = () => MM[shown.unit];

// Returns the unit that the page shows for an option whose unit in the engine is `unit`.
export const shownUnit = (unit) => (unit === "mm" ? shown.unit : unit);

const NOISE = 1e-6; // in mm; larger than the rounding errors of sums, so that 6.175 is always rounded up

// Returns a length without its unit. In millimetres it has `decimals` decimals. In inches it has three decimals; if
// `decimals` is above 2 and three are not exact, it has four.
export function lengthText(mm, decimals = 2) {
  if (shown.unit === "mm") return (mm + NOISE).toFixed(decimals);
  const text = (mm / MM.in).toFixed(4);
  return decimals <= 2 || text.endsWith("0") ? (mm / MM.in).toFixed(3) : text;
}

export const withUnit = (mm, decimals) => `${lengthText(mm, decimals)} ${shown.unit}`;

export const sizeText = (size) => `${size.map((mm) => lengthText(mm)).join(" × ")} ${shown.unit}`;

// Returns a length as the text of a field, without trailing zeros.
export const shortLength = (mm) => String(Number(lengthText(mm, 4)));

// Returns the number that the user typed into a field. If the text is not a number or is out of range, shows a message
// about what was expected, and returns null.
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
