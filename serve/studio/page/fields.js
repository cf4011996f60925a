// Fields: what a parameter or a setting is chosen with.
//
// A control is made of inputs. It calls change(text) while its value changes, and
// finish() when that ends. What is being typed is not touched by what comes from
// elsewhere.

const kFonts = ["Liberation Sans", "Liberation Sans:style=Bold", "Liberation Sans:style=Italic",
  "Liberation Serif", "Liberation Serif:style=Bold", "Liberation Mono", "DejaVu Sans"];

let madeIds = 0;

// An element with properties, attributes that begin with "aria-", and children.
function build(name, properties = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith("aria-") || key === "role" || key === "list") element.setAttribute(key, value);
    else element[key] = value;
  }
  element.append(...children);
  return element;
}

function setAttribute(element, name, value) {
  if (value === undefined) element.removeAttribute(name);
  else element.setAttribute(name, value);
}

// A number within limits. What is typed may be between steps. What is not a number,
// or beyond the limits, is marked and waits until the field is left.
class NumberControl {
  constructor(change, finish) {
    Object.assign(this, {change, finish});
    this.input = build("input", {type: "number", inputMode: "decimal", autocomplete: "off"});
    this.elements = [this.input];
    this.isTyping = false;
    this.input.oninput = () => this.type();
    this.input.onchange = this.input.onblur = () => this.leave();
  }

  update(parameter) {
    this.parameter = parameter;
    setAttribute(this.input, "min", parameter.min);
    setAttribute(this.input, "max", parameter.max);
    setAttribute(this.input, "step", parameter.step ?? "any");
  }

  type() {
    this.isTyping = true;
    const number = numberOf(this.input.value);
    const isGood = number !== null && nearest(this.parameter, number) === number;
    this.input.setAttribute("aria-invalid", !isGood);
    if (isGood) this.change(textOf(number));
  }

  leave() {
    if (!this.isTyping) return;
    this.isTyping = false;
    const number = numberOf(this.input.value);
    if (number !== null) this.change(textOf(nearest(this.parameter, number)));
    this.finish();
    this.show(this.text);
  }

  show(text) {
    this.text = text;
    if (this.isTyping) return;
    this.input.setAttribute("aria-invalid", false);
    if (numberOf(this.input.value) !== numberOf(text)) this.input.value = text;
  }

  // What is being typed counts no more.
  settle() { this.isTyping = false; }
}

class SliderControl extends NumberControl {
  constructor(change, finish) {
    super(change, finish);
    this.slider = build("input", {type: "range"});
    this.elements = [this.input, this.slider];
    this.slider.oninput = () => {
      this.settle();
      this.change(textOf(Number(this.slider.value)));
    };
    this.slider.onchange = () => this.finish();
  }

  update(parameter) {
    super.update(parameter);
    this.slider.min = parameter.min;
    this.slider.max = parameter.max;
    this.slider.step = parameter.step ?? "any";
  }

  show(text) {
    super.show(text);
    this.slider.value = text;
  }
}

// Some numbers beside each other.
class VectorControl {
  constructor(change, finish, {initial}) {
    this.numbers = initial.map((_, i) => new NumberControl((text) => {
      this.texts[i] = text;
      change(`[${this.texts.join(", ")}]`);
    }, finish));
    this.elements = this.numbers.map(({input}) => input);
  }

  update(parameter) {
    for (const number of this.numbers) number.update(parameter);
  }

  show(text) {
    this.texts = JSON.parse(text).map(textOf);
    this.numbers.forEach((number, i) => number.show(this.texts[i]));
  }

  settle() {
    for (const number of this.numbers) number.settle();
  }
}

class TextControl {
  constructor(change, finish) {
    this.input = build("input", {type: "text", autocomplete: "off", spellcheck: false});
    this.elements = [this.input];
    this.input.oninput = () => change(this.input.value);
    this.input.onchange = finish;
  }

  update({maxLength}) {
    setAttribute(this.input, "maxlength", maxLength);
  }

  show(text) {
    if (this.input.value !== text) this.input.value = text;
  }

  settle() {}
}

// A font's name, with some to choose from.
class FontControl extends TextControl {
  constructor(change, finish) {
    super(change, finish);
    const list = build("datalist", {id: `fonts-${++madeIds}`},
        ...kFonts.map((value) => build("option", {value})));
    this.input.setAttribute("list", list.id);
    this.elements.push(list);
  }
}

// A color by name or number, beside what the browser has to choose one.
class ColorControl extends TextControl {
  constructor(change, finish) {
    super(change, finish);
    this.picker = build("input", {type: "color"});
    this.elements.push(this.picker);
    this.picker.oninput = () => change(this.picker.value);
    this.picker.onchange = finish;
  }

  show(text) {
    super.show(text);
    if (this.text !== text) this.picker.value = hexOf(text);
    this.text = text;
  }
}

// "#rrggbb" of a color's name or number; black where it is none.
function hexOf(text) {
  const context = document.createElement("canvas").getContext("2d");
  context.fillStyle = text;
  return /^#.{6}$/.test(context.fillStyle) ? context.fillStyle : "#000000";
}

class CheckControl {
  constructor(change, finish) {
    this.input = build("input", {type: "checkbox"});
    this.elements = [this.input];
    this.input.onchange = () => {
      change(String(this.input.checked));
      finish();
    };
  }

  update() {}
  show(text) { this.input.checked = text === "true"; }
  settle() {}
}

class ListControl {
  constructor(change, finish) {
    this.select = build("select");
    this.elements = [this.select];
    this.select.onchange = () => {
      change(this.select.value);
      finish();
    };
  }

  update({options}) {
    const wanted = JSON.stringify(options);
    if (this.options === wanted) return;
    this.options = wanted;
    this.select.replaceChildren(...options.map(({name, value}) =>
      build("option", {value: textOf(value), textContent: name})));
  }

  show(text) { this.select.value = text; }
  settle() {}
}

const kControls = {number: NumberControl, slider: SliderControl, vector: VectorControl,
  text: TextControl, font: FontControl, color: ColorControl, check: CheckControl,
  list: ListControl};

// The name of a parameter's control.
function controlOf({type, initial, options, min, max, widget}) {
  if (options) return "list";
  if (Array.isArray(initial)) return "vector";
  if (type === "boolean") return "check";
  if (type === "number") return min !== undefined && max !== undefined ? "slider" : "number";
  return widget === "color" || widget === "font" ? widget : "text";
}

// Of two parameters with the same shape one field can serve both.
function shapeOf(parameter) {
  const {initial} = parameter;
  return `${controlOf(parameter)} ${Array.isArray(initial) ? initial.length : ""}`;
}

// A labelled control, with a button that brings the parameter's own value back.
class Field {
  // change(text) and finish() as of a control; reset() when the button is pressed
  constructor(parameter, change, finish, reset) {
    const id = `field-${++madeIds}`;
    const kind = controlOf(parameter);
    this.control = new kControls[kind](change, finish, parameter);
    this.label = build("label", {htmlFor: id});
    this.reset = build("button", {className: "reset", type: "button", textContent: "↺",
      onclick: () => {
        this.settle();
        reset();
      }});
    this.element = build("div", {className: `field ${kind}`}, this.label, this.reset,
        ...this.control.elements);
    this.control.elements[0].id = id;
    this.update(parameter);
  }

  update(parameter) {
    const {name, caption, initial} = parameter;
    this.parameter = parameter;
    this.element.dataset.name = name;
    this.label.textContent = caption || name;
    this.label.title = name;
    this.reset.title = word("resetTitle", textOf(initial));
    this.reset.setAttribute("aria-label", word("resetLabel", caption || name, textOf(initial)));
    this.control.elements.slice(1).forEach((element, i) => element.setAttribute("aria-label",
        Array.isArray(initial) ? word("component", caption || name, i + 2) : caption || name));
    this.control.update(parameter);
  }

  show(text) {
    this.control.show(text);
    this.reset.disabled = text === textOf(this.parameter.initial);
  }

  settle() { this.control.settle(); }
}

// Makes the elements the parent's children, in that order. The one with the focus is
// not moved, so that it keeps it.
function arrange(parent, elements) {
  for (const child of [...parent.children]) {
    if (!elements.includes(child)) child.remove();
  }
  elements.forEach((element, i) => {
    if (element.contains(document.activeElement)) {
      while (parent.children[i] !== element && parent.contains(element)) {
        parent.append(parent.children[i]);
      }
    }
    if (parent.children[i] !== element) parent.insertBefore(element, parent.children[i] || null);
  });
}
