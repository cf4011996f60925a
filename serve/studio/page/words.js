// What the studio's own part of the page says, in one place, for translators.
// {0}, {1}, … are put in.

const kStudioWords = {
  "not-connected": "Not connected. Is lamina studio still running?",
  "working": "Working …",
  "timed": "Layer after {0} ms, all after {1} ms",
  "failed": "The design fails; the picture is the last that worked.",
  "failed-first": "The design fails: see the messages.",
  "refused": "The program answers with status {0}.",
  "no-messages": "No messages",
  "errors": "{0} errors", "error": "1 error",
  "warnings": "{0} warnings", "warning": "1 warning",
  "others": "{0} messages", "other": "1 message",
  "reset-one": "Back to {0}",
  "reset-title": "Set {0} back to {1}",
  "component": "{0}, number {1}",
  "no-group": "Parameters",
  "none": "none",
  "setting-layer": "layer height [mm]",
  "setting-minFeature": "mark what is thinner than [mm]",
  "setting-supports": "supports",
  "setting-printer": "printer",
  "setting-material": "material",
  "setting-metal": "metal",
  "print": "Print",
  "volume": "Volume",
  "size": "Size",
  "size-text": "{0} × {1} × {2} mm",
  "volume-text": "{0} mm³",
  "grams": "{0} g",
  "changed-count": "{0} changed",
  "set-of-file": "from the design’s JSON file",
  "set-saved": "Saved set “{0}”. Download the sets to keep them.",
  "set-download": "Download the set {0}",
  "set-remove": "Remove the set {0}",
  "sets-loaded": "Read {0} sets.", "set-loaded": "Read 1 set.",
  "sets-damaged": "{0} is not a file of parameter sets: {1}",
  "making": "Making {0} …",
  "made": "Saved {0}.",
  "output-failed": "{0} could not be made: see the messages.",
  "link-copied": "Copied the link.",
  "link-shown": "The link is in the address bar.",
  "nothing-to-write": "All values are those of the file.",
  "written": "Wrote {0}.",
  "source-changed": "The file has changed meanwhile. Look at the values again and repeat.",
  "keep": "Keep as A",
  "keep-again": "Keep this as A",
};

// What keys do, for the list of them.
const kStudioKeys = {
  "P": "show or hide the parameters",
  "K": "keep what is shown as A, to compare",
  "Ctrl+Z, Ctrl+Shift+Z": "undo, redo a change of the parameters",
};

// The text of a key, with values put in.
function say(key, ...values) {
  return kStudioWords[key].replace(/\{(\d)\}/g, (_, i) => values[i]);
}

// "1 error", "3 errors".
function sayCount(count, one, many) {
  return count === 1 ? say(one) : say(many, count);
}
