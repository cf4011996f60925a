// The studio's page: its parts, and what goes between them.

const kNoticeTime = 6000;   // how long news are shown [ms]
const kWorkingTime = 300;   // a run that takes longer is worth a word [ms]
const kLinkTime = 300;      // the address follows after so long without change [ms]

class Studio {
  constructor() {
    this.viewer = null;
    this.shown = null;      // {part, report, values, settings} of what is on the page
    this.sent = null;       // {values, settings, differing} of the last choice sent
    this.hello = null;
    this.valuesOf = new Map();  // of designs that were left
    this.choice = new Choice(() => this.change());
    this.wire = new Wire(new HttpTransport(), {
      choose: () => ({...this.choice.toSend(), z: this.viewer ? this.viewer.height : null}),
      begin: () => this.begin(),
      take: (event) => this.take(event),
      lose: () => this.tell("lost", word("notConnected")),
      refuse: (status, text) =>
        this.tell("failed", typeof text === "string" && text ? text : word("refused", status)),
    });
    this.form = new Form(byId("form"), this.choice);
    this.settings = new SettingsForm(byId("settings"), this.choice);
    this.messages = new MessageList();
    this.figures = new Figures();
    const notice = (text, isLasting) => this.notice(text, isLasting);
    this.sets = new Sets(this.choice, {notice, apply: (values) => this.replace(values)});
    this.comparison = new Comparison({
      shown: () => this.shown,
      captions: () => new Map(this.choice.parameters.map(({name, caption}) => [name, caption])),
      apply: (kept) => {
        this.choice.settings = kept.settings;
        this.replace(kept.values);
      },
    });
    this.actions = new Actions(this.wire,
        {notice, messages: (messages) => this.messages.show(messages)});
    this.bindButtons();
    this.bindKeys();
    byId("keys").querySelector("dl").append(...Object.entries(kStudioKeys).flatMap(
        ([key, text]) => [build("dt", {textContent: key}), build("dd", {textContent: word(text)})]));
    window.addEventListener("hashchange", () => this.followLink());
  }

  open() {
    putWords(document);
    this.setPanel(!matchMedia(kPhone).matches);
    byId("working").hidden = true;
    this.tell("working", word("atWork"));
    this.wire.open();
  }

  // The choice is sent.
  begin() {
    const {choice} = this;
    this.sent = {values: choice.values, settings: choice.allSettings(),
      differing: choice.differing()};
    this.hasMessages = false;
  }

  // What was chosen has changed, by whom ever.
  change() {
    this.show();
    this.wire.change();
    this.expectWork();
    clearTimeout(this.linkTimer);
    this.linkTimer = setTimeout(() => this.writeLink(), kLinkTime);
  }

  // Shows the choice.
  show() {
    const {design} = this.choice;
    byId("design").value = byId("title").textContent = design;
    document.title = word("title", design);
    this.form.show();
    this.settings.show();
    this.sets.mark();
    const {past, future, values, kept} = this.choice;
    byId("undo").disabled = past.length === 0 && values === kept;
    byId("redo").disabled = future.length === 0;
    byId("reset-all").disabled = this.choice.differing().size === 0;
  }

  // Other values all at once; what is being typed counts no more.
  replace(values) {
    this.form.settle();
    this.choice.replace(values);
  }

  travel(step) {
    this.form.settle();
    this.choice[step]();
    this.show();
  }

  take(event) {
    const takers = {hello: "takeHello", form: "takeForm", messages: "takeMessages",
      layer: "takeLayer", part: "takePart", report: "takeReport", end: "takeEnd"};
    if (event.kind in takers) this[takers[event.kind]](event);
    if (event.kind !== "end") this.expectWork();
  }

  takeHello(hello) {
    const {choice} = this;
    const isFirst = this.hello === null;
    this.hello = hello;
    choice.ownSettings = hello.settings;
    this.settings.take(hello.settings, hello);
    this.actions.takeFormats(hello.formats);
    byId("design").replaceChildren(...hello.designs.map((name) =>
      build("option", {value: name, textContent: name})));
    byId("design").hidden = hello.designs.length < 2;
    if (isFirst) {
      const {design, values, settings} = choice.readLink(location.hash.slice(1));
      choice.settings = this.settings.possible(settings);
      choice.chooseDesign(hello.designs.includes(design) ? design : hello.design, values);
    } else if (!hello.designs.includes(choice.design)) {
      this.chooseDesign(hello.design);
    }
    this.show();
  }

  takeForm(form) {
    this.choice.takeForm(form);
    this.form.takeParameters(form.parameters);
    this.sets.take(form.sets);
    byId("no-parameters").hidden = form.parameters.length > 0;
    byId("hidden-row").hidden = !form.parameters.some(({widget}) => widget === "hidden");
    this.show();
    // What is typed may differ from the new form's values, though not from the old
    // one's.
    if (!hasSameEntries(this.sent.differing, this.choice.differing())) this.wire.change();
  }

  takeMessages({messages}) {
    this.hasMessages = true;
    this.messages.show(messages);
  }

  takeLayer(event) {
    if (this.viewer) this.viewer.showLayer(readLayer(event));
  }

  takePart({facts, contours}) {
    const part = readPart(facts, bytesOf(contours));
    this.shown = {part, report: null, values: this.choice.all(this.sent.values),
      settings: this.sent.settings};
    if (this.viewer) {
      this.viewer.setPart(part);
    } else {
      this.viewer = new Viewer(part);
      this.comparison.open(this.viewer);
    }
    this.comparison.show();
  }

  takeReport(report) {
    if (this.shown) this.shown.report = report;
    this.figures.show(report, this.sent.settings.metal);
    this.comparison.show();
  }

  takeEnd({isWell, milliseconds}) {
    clearTimeout(this.workTimer);
    if (!this.hasMessages) this.messages.show([]);
    document.body.classList.toggle("stale", !isWell);
    if (isWell) {
      this.tell("ready", milliseconds ? word("timed",
          ...[milliseconds.layer, milliseconds.all].map((time) => fixed(time, 0))) : "");
    } else {
      this.figures.dim();
      this.tell("failed", word(this.shown ? "failed" : "failedFirst"));
    }
    document.documentElement.dataset.ready = "true";
  }

  // Says that the program works, if it goes on to.
  expectWork() {
    clearTimeout(this.workTimer);
    this.workTimer = setTimeout(() => {
      if (this.wire.client === null) return;
      this.tell("working", word("atWork"));
      this.figures.dim();
    }, kWorkingTime);
  }

  // state: ready, working, failed or lost
  tell(state, text) {
    clearTimeout(this.workTimer);
    byId("state").setAttribute("aria-live", state === "failed" || state === "lost" ? "polite" : "off");
    byId("state").dataset.state = state;
    byId("state").textContent = text;
    byId("state").title = text;
  }

  notice(text, isLasting = false) {
    byId("notice").textContent = text;
    byId("notice").hidden = false;
    clearTimeout(this.noticeTimer);
    if (isLasting) return;
    this.noticeTimer = setTimeout(() => { byId("notice").hidden = true; }, kNoticeTime);
  }

  chooseDesign(design) {
    this.valuesOf.set(this.choice.design, this.choice.values);
    this.choice.chooseDesign(design, this.valuesOf.get(design) || new Map());
  }

  // The address holds the choice, and what it had besides.
  writeLink() {
    const known = ["design", ...Object.keys(this.choice.ownSettings)];
    const others = [...new URLSearchParams(location.hash.slice(1))]
        .filter(([name]) => !name.startsWith("p.") && !known.includes(name));
    const link = new URLSearchParams([...new URLSearchParams(this.choice.toLink()), ...others]);
    this.link = `#${link}`;
    history.replaceState(null, "", this.link);
  }

  followLink() {
    if (location.hash === this.link || this.hello === null) return;
    const {design, values, settings} = this.choice.readLink(location.hash.slice(1));
    this.choice.settings = this.settings.possible(settings);
    if (design !== this.choice.design && this.hello.designs.includes(design)) {
      this.chooseDesign(design);
    }
    this.replace(values);
  }

  setPanel(isOpen) {
    byId("panel").hidden = !isOpen;
    byId("panel-button").setAttribute("aria-pressed", isOpen);
  }

  bindButtons() {
    byId("undo").onclick = () => this.travel("undo");
    byId("redo").onclick = () => this.travel("redo");
    byId("reset-all").onclick = () => this.replace(new Map());
    byId("panel-button").onclick = () => this.setPanel(byId("panel").hidden);
    byId("badge").onclick = () => {
      this.setPanel(true);
      byId("messages").open = true;
      byId("messages").scrollIntoView({block: "nearest"});
    };
    byId("design").onchange = () => this.chooseDesign(byId("design").value);
    byId("show-hidden").onchange = () => {
      this.form.isShowingHidden = byId("show-hidden").checked;
      this.form.show();
    };
  }

  // Undo is the page's own in fields, too: their steps are steps of the design.
  bindKeys() {
    document.addEventListener("keydown", (event) => {
      const key = event.key.toLowerCase();
      if (document.querySelector("dialog[open]") || event.altKey) return;
      let act = null;
      if (event.ctrlKey || event.metaKey) {
        if (key === "z") act = () => this.travel(event.shiftKey ? "redo" : "undo");
        if (key === "y") act = () => this.travel("redo");
      } else if (!event.target.closest(kKeyTakers)) {
        if (key === "p") act = () => this.setPanel(byId("panel").hidden);
        if (key === "k") act = () => byId("keep").click();
      }
      if (act === null || event.target.matches("#set-name")) return;
      event.preventDefault();
      act();
    });
  }
}

openTheme((/theme=(dark|light)/.exec(location.hash) || [])[1]);
window.studio = new Studio();
window.studio.open();
