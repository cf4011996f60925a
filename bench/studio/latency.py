"""From an input event of a slider to the painted layer, in headless Chromium.

usage: latency.py LAMINA [DESIGN PARAMETER]... [--changes N]

Without designs: the examples that docs/performance.md lists. Prints a table:
median and 95 % of all changes, each begun when the one before is done, and what
the time is made of. 'to run': from the event until the program has the choice;
'layer': what the program takes to the layer in view; 'to paint': the rest.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(__file__), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "tests", "browser"))
from browser import Browser  # noqa: E402

EXAMPLES = [("solitaire", "width_back"), ("signet", "face_length"),
            ("hoop", "inner"), ("medal", "height")]

# Changes a slider, waits for the paint of what comes of it, and again.
SCRIPT = """
(async (name, changes) => {
  const field = document.querySelector(`[data-name="${name}"] input[type=range]`);
  const [min, max, step] = [field.min, field.max, field.step].map(Number);
  const steps = Math.round((max - min) / step);
  const {viewer, wire} = studio;
  const times = [];
  const transport = wire.transport;
  const send = transport.send;
  let posted = 0;
  transport.send = async (...words) => {
    const answer = await send.apply(transport, words);
    posted = performance.now();
    return answer;
  };
  const done = (kind) => new Promise((resolve) => {
    const take = wire.take;
    wire.take = (event) => {
      take(event);
      if (event.kind !== kind) return;
      wire.take = take;
      resolve(event);
    };
  });
  // A message comes behind the paint of the frame that is drawn now.
  const painted = () => new Promise((resolve) => requestAnimationFrame(() => {
    const {port1, port2} = new MessageChannel();
    port1.onmessage = resolve;
    port2.postMessage(0);
  }));
  for (let i = 0; i < changes; ++i) {
    const ended = done("end");
    const layer = done("layer").then(painted).then(() => performance.now());
    field.value = min + step * (i % (steps + 1));
    const begin = performance.now();
    field.dispatchEvent(new Event("input", {bubbles: true}));
    const shown = await layer;
    const {milliseconds} = await ended;
    times.push([shown - begin, posted - begin, milliseconds.layer, milliseconds.all]);
    field.dispatchEvent(new Event("change", {bubbles: true}));
  }
  return times;
})"""


def measure(lamina, path, name, changes):
    with tempfile.TemporaryDirectory() as folder:
        studio = subprocess.Popen(
            [lamina, "studio", path],
            stdout=subprocess.PIPE, text=True, env={**os.environ,
                                                    "XDG_RUNTIME_DIR": folder})
        browser = Browser(1400, 900)
        try:
            address = studio.stdout.readline().strip()
            browser.open(address)
            browser.evaluate(
                "new Promise((resolve) => { const wait = () => studio.viewer ?"
                " resolve() : setTimeout(wait, 20); wait(); })")
            return browser.evaluate(f"{SCRIPT}({name!r}, {changes})")
        finally:
            browser.close()
            studio.kill()
            studio.wait()


def row(label, times):
    def at(column, share):
        ordered = sorted(time[column] for time in times)
        return ordered[min(len(ordered) - 1, int(share * len(ordered)))]

    rest = statistics.median(t[0] - t[1] - t[2] for t in times)
    print(f"{label:<12}{len(times):>8}{at(0, .5):>9.1f}{at(0, .95):>9.1f}"
          f"{at(1, .5):>9.1f}{at(2, .5):>9.1f}{rest:>10.1f}{at(3, .5):>9.1f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lamina")
    parser.add_argument("designs", nargs="*")
    parser.add_argument("--changes", type=int, default=200)
    options = parser.parse_args()
    words = options.designs
    designs = list(zip(words[::2], words[1::2], strict=True)) or [
        (os.path.join(ROOT, "examples", f"{name}.scad"), parameter)
        for name, parameter in EXAMPLES]
    print(f"{'design':<12}{'changes':>8}{'median':>9}{'95 %':>9}{'to run':>9}"
          f"{'layer':>9}{'to paint':>10}{'all':>9}  [ms]")
    for path, name in designs:
        label = os.path.basename(path).removesuffix(".scad")
        row(label, measure(options.lamina, path, name, options.changes))


main()
