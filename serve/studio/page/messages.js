// What the program has to say of the design, errors first.

const kSeverities = ["error", "warning", "deprecated", "echo", "note"];

class MessageList {
  constructor() {
    this.box = byId("messages");
    this.show([]);
  }

  show(messages) {
    const rank = ({severity}) => kSeverities.indexOf(severity);
    const sorted = [...messages].sort((a, b) => rank(a) - rank(b));
    const errors = messages.filter(({severity}) => severity === "error").length;
    byId("message-list").replaceChildren(...sorted.map((message) => this.itemOf(message)));
    byId("message-count").textContent = this.countText(messages);
    byId("badge").textContent = byId("message-count").textContent;
    byId("badge").hidden = this.box.hidden = messages.length === 0;
    byId("badge").dataset.severity = this.box.dataset.severity =
        messages.length ? sorted[0].severity : "";
    if (errors > 0 && !this.hasErrors) this.box.open = true;
    this.hasErrors = errors > 0;
  }

  countText(messages) {
    const count = (...severities) =>
      messages.filter(({severity}) => severities.includes(severity)).length;
    return [
      ["errors", count("error")],
      ["warnings", count("warning", "deprecated")],
      ["messages", count("echo", "note")],
    ].filter(([, number]) => number > 0).map((parts) => word(...parts)).join(", ") ||
      word("noMessages");
  }

  itemOf({severity, message, file, line, column, text}) {
    const place = [file, line, column].filter((part) => part !== undefined).join(":");
    const item = build("li", {className: "message"},
        build("strong", {className: severity, textContent: severity}),
        build("span", {textContent: message}));
    if (place) item.append(build("small", {textContent: place}));
    const lines = this.caretText(text || "", message);
    if (lines) item.append(build("pre", {textContent: lines, tabIndex: 0}));
    return item;
  }

  // The lines with carets, without the first one where that repeats the message.
  caretText(text, message) {
    const [first, ...rest] = text.trimEnd().split("\n");
    return first.endsWith(message) ? rest.join("\n") : text.trimEnd();
  }
}
