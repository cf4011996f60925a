// Values of parameters as texts, in the sense of OpenSCAD's parameter sets: a text
// is itself, a vector is "[1, 2.5]".

const textOf = (value) => Array.isArray(value) ? `[${value.join(", ")}]` : String(value);

// null where a text is not a number.
function numberOf(text) {
  const number = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(number) ? number : null;
}

// The number itself, or the limit that it is beyond.
function nearest({min = -Infinity, max = Infinity}, number) {
  return Math.min(max, Math.max(min, number));
}

// The value that a text means to a parameter, within its limits; null where it means
// none.
function valueOf(parameter, text) {
  const {type, initial, options, maxLength} = parameter;
  if (options) {
    const option = options.find(({value}) => typeof value === "number" ?
      value === numberOf(text) : textOf(value) === text);
    return option ? option.value : null;
  }
  if (Array.isArray(initial)) {
    const [, list] = /^\s*\[([^\]]*)\]\s*$/.exec(text) || [];
    const numbers = (list || "").split(",").map(numberOf);
    return numbers.length === initial.length && !numbers.includes(null) ?
      numbers.map((number) => nearest(parameter, number)) : null;
  }
  if (type === "boolean") return {true: true, false: false}[text] ?? null;
  if (type === "number") {
    const number = numberOf(text);
    return number === null ? null : nearest(parameter, number);
  }
  return maxLength === undefined ? text : text.slice(0, maxLength);
}

// The names of parameters under their headings, in the order of the form. OpenSCAD
// shows the group Global with each of the others: it comes first.
function groupsOf(parameters) {
  const groups = groupBy(parameters, ({group}) => group || "");
  const global = groups.get("Global");
  groups.delete("Global");
  return global ? new Map([["Global", global], ...groups]) : groups;
}
