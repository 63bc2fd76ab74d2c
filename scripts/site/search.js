// Searches the pages. The texts are in texts.js, which is loaded when the user first searches. This also works for
// pages opened from disk.
const root = document.documentElement.dataset.root, field = document.querySelector("#search"), found = document.querySelector("#found");
const menu = document.querySelector(".side details");
const wide = matchMedia("(min-width: 801px)");
const fold = () => { menu.open = wide.matches; };
wide.addEventListener("change", fold);
fold();

let loading = null;
function texts() {
  loading ??= new Promise((resolve) => {
    const script = document.createElement("script");
    script.src = `${root}texts.js`;
    script.onload = () => resolve(window.siteTexts);
    document.head.append(script);
  });
  return loading;
}

// A match in a heading counts ten times as much as one in the text. All words must occur.
function score({heading, text}, words) {
  let sum = 0;
  for (const word of words) {
    const count = 10 * heading.toLowerCase().split(word).length - 10 + text.toLowerCase().split(word).length - 1;
    if (count === 0) return 0;
    sum += Math.min(count, 15);
  }
  return sum;
}

function item({address, page, heading, text}, word) {
  const link = document.createElement("a"), small = document.createElement("small"), li = document.createElement("li");
  const at = Math.max(0, text.toLowerCase().indexOf(word) - 30);
  link.href = root + address;
  link.textContent = heading === page ? page : `${page}: ${heading}`;
  small.textContent = (at > 0 ? "… " : "") + text.slice(at, at + 110);
  link.append(small);
  li.append(link);
  return li;
}

async function search() {
  const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
  const all = await texts();
  if (words.join(" ") !== field.value.toLowerCase().split(/\s+/).filter(Boolean).join(" ")) return;
  const best = words.length === 0 ? [] : all.map((each) => [score(each, words), each]).filter(([points]) => points > 0)
    .sort((a, b) => b[0] - a[0]).slice(0, 12);
  found.replaceChildren(...best.map(([, each]) => item(each, words[0])));
  if (words.length > 0 && best.length === 0) found.textContent = "Nothing found.";
}
field.addEventListener("input", search);
field.form.addEventListener("submit", (event) => {
  event.preventDefault();
  found.querySelector("a")?.click();
});
addEventListener("keydown", (event) => {
  if (event.key !== "/" || event.target.matches("input")) return;
  event.preventDefault();
  field.focus();
});
