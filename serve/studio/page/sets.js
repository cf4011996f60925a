// Sets of values: those of the JSON file beside the design, and those that the user
// saves or loads. Files are OpenSCAD's, which both read.

class Sets {
  // apply(values) gets those of a set that was chosen; notice(text) news.
  constructor(choice, {apply, notice}) {
    Object.assign(this, {choice, apply, notice});
    this.ofFile = new Map();
    this.ofDesigns = new Map();  // saved or loaded ones, by design and name
    byId("save-set").onsubmit = (event) => {
      event.preventDefault();
      this.save(byId("set-name").value.trim());
    };
    byId("download-sets").onclick = () => this.download(this.all());
    byId("load-sets").onclick = () => byId("set-file").click();
    byId("set-file").onchange = () => {
      for (const file of byId("set-file").files) this.load(file);
      byId("set-file").value = "";
    };
    this.bindDrop();
  }

  // Files dropped anywhere on the page.
  bindDrop() {
    document.addEventListener("dragover", (event) => {
      if (event.dataTransfer.types.includes("Files")) event.preventDefault();
    });
    document.addEventListener("drop", (event) => {
      if (event.dataTransfer.files.length === 0) return;
      event.preventDefault();
      for (const file of event.dataTransfer.files) this.load(file);
    });
  }

  // sets  as in `form`
  take(sets) {
    this.ofFile = new Map(sets.map(({name, values}) => [name, new Map(Object.entries(values))]));
    this.show();
  }

  get saved() {
    const {design} = this.choice;
    if (!this.ofDesigns.has(design)) this.ofDesigns.set(design, new Map());
    return this.ofDesigns.get(design);
  }

  // By name; a saved set hides that of the file with the same name.
  all() {
    return new Map([...this.ofFile, ...this.saved]);
  }

  show() {
    const sets = [...this.all()];
    byId("no-sets").hidden = sets.length > 0;
    byId("download-sets").disabled = sets.length === 0;
    byId("set-list").replaceChildren(...sets.map(([name, values]) => this.itemOf(name, values)));
    this.mark();
  }

  // Marks the set whose values are chosen.
  mark() {
    const now = this.choice.all();
    [...this.all().values()].forEach((values, i) => {
      const isNow = hasSameEntries(this.choice.all(values), now);
      byId("set-list").children[i].firstChild.setAttribute("aria-pressed", isNow);
    });
  }

  itemOf(name, values) {
    const use = build("button", {className: "set", type: "button", textContent: name,
      title: this.saved.has(name) ? name : word("setOfFile"), onclick: () => this.apply(values)});
    const put = build("button", {className: "small", type: "button", textContent: "↓",
      title: word("setDownload", name), "aria-label": word("setDownload", name),
      onclick: () => this.download(new Map([[name, values]]))});
    const item = build("li", {}, use, put);
    if (this.saved.has(name)) item.append(build("button", {className: "small", type: "button",
      textContent: "×", title: word("setRemove", name), "aria-label": word("setRemove", name),
      onclick: () => {
        this.saved.delete(name);
        this.show();
      }}));
    return item;
  }

  save(name) {
    if (name === "") return;
    this.saved.set(name, this.choice.all());
    byId("set-name").value = "";
    this.notice(word("setSaved", name));
    this.show();
  }

  download(sets) {
    const parameterSets = Object.fromEntries(
        [...sets].map(([name, values]) => [name, Object.fromEntries(values)]));
    const text = JSON.stringify({parameterSets, fileFormatVersion: "1"}, null, 4) + "\n";
    const address = URL.createObjectURL(new Blob([text], {type: "application/json"}));
    download(address, this.choice.design.replace(/^.*\/|\.[^.]*$/g, "") + ".json");
    setTimeout(() => URL.revokeObjectURL(address), 60000);
  }

  // Adds the sets of a file; of one with a single set, applies it.
  async load(file) {
    try {
      const {parameterSets} = JSON.parse(await file.text());
      const sets = Object.entries(parameterSets).map(([name, values]) =>
        [name, new Map(Object.entries(values).map(([key, value]) => [key, textOf(value)]))]);
      for (const [name, values] of sets) this.saved.set(name, values);
      this.show();
      this.notice(word("setsLoaded", sets.length));
      if (sets.length === 1) this.apply(sets[0][1]);
    } catch (error) {
      this.notice(word("setsDamaged", file.name, error.message));
    }
  }
}

// Saves what is at an address under a name.
function download(address, name) {
  build("a", {href: address, download: name}).click();
}
