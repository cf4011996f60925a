// A form of what a design offers (?design=NAME, or the first), and a quote for it.
const [form, text, picture] = ["form", "quote", "picture"].map((id) => document.getElementById(id));

async function ask(path, options) {
  const answer = await fetch(`/api/designs${path}`, options);
  const isJson = answer.headers.get("Content-Type")?.includes("json");
  const body = isJson ? await answer.json() : {detail: `Please try again later (${answer.status})`};
  if (!answer.ok) throw new Error(body.detail);
  return body;
}

function field(name, {type, default: initial, oneOf, minimum, maximum, maxLength, ...rule}) {
  const made = Object.assign(document.createElement(oneOf ? "select" : "input"), {name});
  for (const {const: value, title} of oneOf ?? [])
    made.add(new Option(title ?? value, JSON.stringify(value), false, value === initial));
  if (type === "boolean") Object.assign(made, {type: "checkbox", checked: initial});
  if (type === "number" && !oneOf)
    Object.assign(made, {type, min: minimum ?? "", max: maximum ?? "", step: rule["x-step"] ?? "any"});
  if (maxLength) made.maxLength = maxLength;
  if (!oneOf) made.value = type === "array" ? JSON.stringify(initial) : initial;
  made.read = () => type === "boolean" ? made.checked
    : type === "string" && !oneOf ? made.value : JSON.parse(made.value || "null");
  const label = Object.assign(document.createElement("label"), {textContent: rule.description ?? name});
  label.append(made);
  return label;
}

async function quote(signal) {
  const values = Object.fromEntries([...form.elements].map((made) => [made.name, made.read()]));
  const [headers, body] = [{"Content-Type": "application/json"}, JSON.stringify({values})];
  const {metal, size} = await ask(`/${design}/quote`, {method: "POST", headers, body, signal});
  text.textContent = `${metal.price.toFixed(2)} ${metal.currency}, ${metal.grams.toFixed(2)} g of ${
    metal.name}, ${size.map((length) => length.toFixed(1)).join(" × ")} mm`;
  picture.src = `/api/designs/${design}/picture.png?order=${encodeURIComponent(body)}`;
}

let newest = new AbortController();
form.oninput = () => {  // what was asked for an older choice is given up
  newest.abort();
  const {signal} = newest = new AbortController();
  const show = (error) => { if (!signal.aborted) text.textContent = error.message; };
  setTimeout(() => signal.aborted || quote(signal).catch(show), 150);
};
const design = new URLSearchParams(location.search).get("design") ?? (await ask(""))[0];
const {properties} = await ask(`/${design}/parameters`);
form.append(...Object.entries(properties).map(([name, rule]) => field(name, rule)));
form.oninput();
