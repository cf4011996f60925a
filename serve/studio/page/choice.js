// What the user has chosen: a design, values of its parameters, and settings.
//
// Values are kept by name as texts, those too that the form has no parameter for (at
// the moment): a file that is being edited comes and goes. Steps that can be undone
// are gestures: a drag of a slider is one.

const kGesture = 600;  // changes of one parameter that follow sooner are one step [ms]

class Choice {
  // change() is called after each change of what is sent.
  constructor(change) {
    this.change = change;
    this.design = "";
    this.formKey = "";
    this.parameters = [];
    this.settings = {};       // those chosen
    this.ownSettings = {};    // those of the program
    this.begin(new Map());
  }

  // Values without a history: what was before belongs to another design.
  begin(values) {
    this.values = values;
    this.kept = values;  // as of the last step
    this.past = [];
    this.future = [];
    this.lastStep = {name: null, time: 0};
  }

  // Another design, whose form is not known yet.
  chooseDesign(design, values) {
    this.design = design;
    this.formKey = "";
    this.parameters = [];
    this.begin(values);
    this.change();
  }

  takeForm({key, parameters}) {
    this.formKey = key;
    this.parameters = parameters;
  }

  // The parameter's value as it is shown and sent.
  textOf(parameter, values = this.values) {
    const text = values.get(parameter.name);
    const value = text === undefined ? null : valueOf(parameter, text);
    return textOf(value === null ? parameter.initial : value);
  }

  isChanged(parameter) {
    return this.textOf(parameter) !== textOf(parameter.initial);
  }

  // All values, by name, as they are now or were at another time.
  all(values = this.values) {
    return new Map(this.parameters.map((parameter) =>
      [parameter.name, this.textOf(parameter, values)]));
  }

  // Those that differ from the design's own; before that is known, all that were given.
  differing() {
    if (this.formKey === "") return this.values;
    return new Map(this.parameters.filter((parameter) => this.isChanged(parameter))
        .map((parameter) => [parameter.name, this.textOf(parameter)]));
  }

  // A value while a gesture goes on; no text: the design's own.
  set(name, text) {
    if (this.values.get(name) === text) return;
    this.values = new Map(this.values);
    if (text === undefined) this.values.delete(name);
    else this.values.set(name, text);
    this.change();
  }

  // Ends a gesture. name  of its parameter; null where it had more of them
  finish(name = null) {
    if (hasSameEntries(this.values, this.kept)) return;
    const time = performance.now();
    const isSame = name !== null && name === this.lastStep.name &&
      time - this.lastStep.time < kGesture;
    if (!isSame) this.past.push(this.kept);
    this.lastStep = {name, time};
    this.kept = this.values;
    this.future = [];
  }

  // All values at once; those not named become the design's own.
  replace(values) {
    this.finish();
    this.values = new Map(values);
    this.finish();
    this.change();
  }

  undo() {
    this.finish();
    this.travel(this.past, this.future);
  }

  redo() {
    this.finish();
    this.travel(this.future, this.past);
  }

  travel(from, to) {
    if (from.length === 0) return;
    to.push(this.kept);
    this.values = this.kept = from.pop();
    this.lastStep.name = null;
    this.change();
  }

  setSetting(name, value) {
    this.settings = {...this.settings, [name]: value};
    this.change();
  }

  allSettings() {
    return {...this.ownSettings, ...this.settings};
  }

  // As the program takes it.
  toSend() {
    return {design: this.design, values: Object.fromEntries(this.differing()),
      settings: this.allSettings(), form: this.formKey};
  }

  // What the address holds behind '#': "design=ring.scad&p.size=54&layer=0.05".
  toLink() {
    const settings = Object.entries(this.settings)
        .filter(([name, value]) => value !== this.ownSettings[name]);
    return new URLSearchParams([
      ["design", this.design],
      ...[...this.differing()].map(([name, text]) => [`p.${name}`, text]),
      ...settings,
    ]).toString();
  }

  // {design, values, settings} from what toLink() wrote. What it does not name is as
  // the design and the program have it.
  readLink(link) {
    const entries = [...new URLSearchParams(link)];
    return {
      design: new Map(entries).get("design"),
      values: new Map(entries.filter(([name]) => name.startsWith("p."))
          .map(([name, text]) => [name.slice(2), text])),
      settings: Object.fromEntries(entries
          .filter(([name]) => Object.hasOwn(this.ownSettings, name))
          .map(([name, text]) => [name, settingOf(this.ownSettings[name], text)])),
    };
  }
}

// A setting of the same type as another; that itself where the text says none.
function settingOf(like, text) {
  if (typeof like === "number") return numberOf(text) ?? like;
  return typeof like === "boolean" ? text === "true" : text;
}

function hasSameEntries(a, b) {
  return a.size === b.size && [...a].every(([name, text]) => b.get(name) === text);
}
