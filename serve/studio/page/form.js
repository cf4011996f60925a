// The form: fields for the design's parameters, in their groups.

class Form {
  constructor(element, choice) {
    this.element = element;
    this.choice = choice;
    this.fields = new Map();    // by the parameter's name
    this.sections = new Map();  // by the group's name
    this.isShowingHidden = false;
  }

  // Fields of parameters that are still there stay, with what is typed in them.
  takeParameters(parameters) {
    const fields = new Map(parameters.map((parameter) =>
      [parameter.name, this.fieldOf(parameter)]));
    const sections = [...groupsOf(parameters)].map(([group, members]) => {
      const section = this.sectionOf(group);
      arrange(section.body, members.map(({name}) => fields.get(name).element));
      return section.element;
    });
    this.fields = fields;
    arrange(this.element, sections);
    this.show();
  }

  fieldOf(parameter) {
    const {name} = parameter;
    const old = this.fields.get(name);
    if (old && shapeOf(old.parameter) === shapeOf(parameter)) {
      old.update(parameter);
      return old;
    }
    return new Field(parameter, (text) => this.choice.set(name, text),
        () => this.choice.finish(name), () => this.reset(name));
  }

  sectionOf(group) {
    if (!this.sections.has(group)) {
      const count = build("small");
      const body = build("div", {className: "fields"});
      const element = build("details", {className: "group", open: true},
          build("summary", {}, group || word("noGroup"), count), body);
      this.sections.set(group, {element, body, count});
    }
    return this.sections.get(group);
  }

  reset(name) {
    this.choice.finish();
    this.choice.set(name, undefined);
    this.choice.finish();
  }

  // What is typed and not sent yet is given up.
  settle() {
    for (const field of this.fields.values()) field.settle();
  }

  show() {
    for (const [group, {element, body, count}] of this.sections) {
      const parameters = [...this.fields.values()].map(({parameter}) => parameter)
          .filter((parameter) => (parameter.group || "") === group);
      const changed = parameters.filter((parameter) => this.choice.isChanged(parameter)).length;
      count.textContent = changed ? word("changed", changed) : "";
      for (const field of body.children) {
        const {parameter} = this.fields.get(field.dataset.name);
        field.hidden = parameter.widget === "hidden" && !this.isShowingHidden;
      }
      element.hidden = [...body.children].every(({hidden}) => hidden);
    }
    for (const field of this.fields.values()) field.show(this.choice.textOf(field.parameter));
  }
}

// The settings of the print, in fields as those of parameters.
class SettingsForm {
  constructor(element, choice) {
    this.element = element;
    this.choice = choice;
    this.fields = new Map();
  }

  // own  the program's settings; lists  its {printers, materials, metals}
  take(own, {printers, materials, metals}) {
    const listed = (names) => [{name: word("none"), value: ""},
      ...names.map((name) => ({name, value: name}))];
    const kinds = {
      layer: {type: "number", min: 0.005, step: 0.005},
      minFeature: {type: "number", min: 0, step: 0.05},
      supports: {type: "boolean"},
      printer: {type: "string", options: listed(printers)},
      material: {type: "string", options: listed(materials)},
      metal: {type: "string", options: listed(metals)},
    };
    for (const [name, kind] of Object.entries(kinds)) {
      const setting = {...kind, name, caption: word(`${name}Setting`), initial: own[name]};
      if (this.fields.has(name)) this.fields.get(name).update(setting);
      else this.fields.set(name, this.fieldOf(setting));
    }
    arrange(this.element, [...this.fields.values()].map(({element}) => element));
    this.show();
  }

  // Without what no setting can have.
  possible(settings) {
    return Object.fromEntries(Object.entries(settings).map(([name, value]) =>
      [name, valueOf(this.fields.get(name).parameter, textOf(value)) ?? this.choice.ownSettings[name]]));
  }

  fieldOf(setting) {
    const {name, initial} = setting;
    const set = (value) => this.choice.setSetting(name, value);
    return new Field(setting, (text) => set(settingOf(initial, text)), () => {},
        () => set(this.choice.ownSettings[name]));
  }

  show() {
    for (const [name, field] of this.fields) {
      field.show(textOf(this.choice.settings[name] ?? this.choice.ownSettings[name]));
    }
  }
}
