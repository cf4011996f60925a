// What is done with a choice: files made of it, and its values written into the
// design.

class Actions {
  // wire      asks the program
  // notice    gets news, as texts, and whether they are shown until others come
  // messages  gets those of a file that could not be made
  constructor(wire, {notice, messages}) {
    Object.assign(this, {wire, notice, messages});
    byId("write-source").onclick = () => this.previewSource();
    byId("cancel-source").onclick = () => byId("source-dialog").close();
    byId("confirm-source").onclick = () => this.writeSource();
    byId("copy-link").onclick = () => this.copyLink();
    const menu = byId("save-menu");
    menu.addEventListener("toggle", (event) => {
      if (event.newState !== "open") return;
      const {left, bottom} = byId("save").getBoundingClientRect();
      menu.style.left = `${Math.max(8, Math.min(left, innerWidth - menu.offsetWidth - 8))}px`;
      menu.style.top = `${bottom + 6}px`;
    });
    menu.addEventListener("click", () => menu.hidePopover());
  }

  // formats  as in `hello`
  takeFormats(formats) {
    byId("formats").replaceChildren(...formats.map(({name, title}) => build("button", {
      type: "button", textContent: title, onclick: () => this.makeFile(name, title)})));
  }

  // Asks, and calls answer[status](body); says what else comes.
  async ask(path, more, answers) {
    try {
      const {status, body} = await this.wire.ask(path, more);
      if (answers[status]) answers[status](body);
      else this.notice(typeof body === "string" && body ? body : word("refused", status));
    } catch {
      this.notice(word("notConnected"));
    }
  }

  makeFile(format, title) {
    this.notice(word("making", title), true);
    return this.ask("/output", {format}, {
      200: ({file, name}) => {
        download(file, name);
        this.notice(word("made", name));
      },
      422: ({messages}) => {
        this.messages(messages);
        this.notice(word("outputFailed", title));
      },
    });
  }

  previewSource() {
    return this.ask("/source", {}, {
      200: ({diff, key}) => {
        if (!diff) {
          this.notice(word("nothingToWrite"));
          return;
        }
        this.key = key;
        byId("source-diff").replaceChildren(...diff.trimEnd().split("\n").map((line) =>
          build("span", {className: kDiffMarks[line[0]] || "", textContent: `${line}\n`})));
        byId("source-dialog").showModal();
      },
      422: ({messages}) => this.messages(messages),
      409: () => this.notice(word("sourceChanged")),
    });
  }

  writeSource() {
    byId("source-dialog").close();
    return this.ask("/source", {key: this.key}, {
      200: ({written}) => this.notice(word("written", written)),
      409: () => this.notice(word("sourceChanged")),
    });
  }

  async copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
      this.notice(word("linkCopied"));
    } catch {
      this.notice(word("linkShown"));
    }
  }
}

const kDiffMarks = {"+": "added", "-": "removed", "@": "place"};
