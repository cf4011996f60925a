// How the page and the program speak (docs/studio.md).
//
// A drag of a slider makes more choices than the program can follow, so the wire
// keeps only the newest and sends it
//   - at once, if the program is idle;
//   - when the layer of the choice before has come, or has taken too long;
//   - where no layer or no part has come for a while, only when one has.

const kLayerPatience = 150;  // how long a layer may keep back the next choice [ms]
const kLongestGap = 400;     // between layers, and between parts [ms]; then one may
const kLongestHold = 1000;   // keep back the next choice so long [ms]
const kRetry = 1000;         // until the next try to connect [ms]

// Server-sent events and requests. Another carrier, as a worker in the browser, has
// the same methods.
class HttpTransport {
  // take(event) gets each event, lose() the news that the connection is lost; it
  // comes back by itself.
  open(take, lose) {
    this.take = take;
    this.lose = lose;
    this.listen();
  }

  listen() {
    this.source = new EventSource("/events");
    this.source.onmessage = ({data}) => this.take(JSON.parse(data));
    this.source.onerror = () => {
      this.lose();
      this.reopen();
    };
  }

  // Connects anew, in a moment. A browser by itself gives up at times.
  reopen() {
    this.source.close();
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.listen(), kRetry);
  }

  // Returns {status, body}; the body is a text where it is not JSON. Throws where
  // no answer comes.
  async send(path, body) {
    const answer = await fetch(path, {
      method: "POST",
      headers: {"Content-Type": "application/json"},
      body: JSON.stringify(body),
    });
    const text = await answer.text();
    const isJson = (answer.headers.get("Content-Type") || "").startsWith("application/json");
    return {status: answer.status, body: isJson ? JSON.parse(text) : text};
  }
}

// Sends the newest choice, and lets through what the program says of the last that
// was sent.
class Wire {
  // choose() returns the choice as it is now, begin() is called when that is sent;
  // take(event) gets what comes of it, refuse(status, text) an answer that it is not
  // taken, and lose() the news that nobody answers.
  constructor(transport, {choose, begin, take, refuse, lose}) {
    Object.assign(this, {transport, choose, begin, take, refuse, lose});
    this.number = 0;
    this.client = null;
    this.run = null;       // of the last choice sent: {begin, awaited, hasEnded}
    this.isDue = false;    // whether there is a choice to send
    this.isPosting = false;
    this.changed = 0;                 // when the choice last changed
    this.last = {layer: 0, part: 0};  // when one last came, or changes began
  }

  open() {
    this.transport.open((event) => this.hear(event), () => this.disconnect());
  }

  // The choice has changed.
  change() {
    const now = performance.now();
    const isFirst = !this.isBusy || now - this.changed > kLongestGap;
    if (isFirst) this.last = {layer: now, part: now};
    this.changed = now;
    this.isDue = true;
    this.pump();
  }

  // Whether something is sent or to be sent that has not been answered in full.
  get isBusy() {
    return this.isDue || this.isPosting || (this.run !== null && !this.run.hasEnded);
  }

  // A request about the choice as it is now, beside the runs. Returns as send().
  ask(path, more) {
    return this.transport.send(path, {...this.choose(), client: this.client,
      number: this.number, ...more});
  }

  hear(event) {
    if (event.kind === "hello") {
      this.client = event.client;
      this.run = null;
      this.isDue = true;
    } else if (event.kind === "changed") {
      this.isDue = true;
    } else if (event.number !== this.number) {
      return;
    } else {
      if (event.kind in this.last) {
        this.last[event.kind] = performance.now();
        this.run.awaited = event.kind === "layer" ? "part" : null;
      }
      if (event.kind === "end") {
        this.run.awaited = null;
        this.run.hasEnded = true;
      }
    }
    this.take(event);
    this.pump();
  }

  pump() {
    clearTimeout(this.timer);
    if (!this.isDue || this.client === null || this.isPosting) return;
    const wait = this.waitTime(performance.now());
    if (wait > 0) this.timer = setTimeout(() => this.pump(), wait);
    else this.post();
  }

  // How long the run of the choice before may keep back the next [ms].
  waitTime(now) {
    const {run, last} = this;
    if (run === null || run.awaited === null) return 0;
    if (now - last[run.awaited] >= kLongestGap) return run.begin + kLongestHold - now;
    return run.awaited === "layer" ? run.begin + kLayerPatience - now : 0;
  }

  async post() {
    const now = performance.now();
    // What was waited for in vain is not waited for again at once.
    for (const kind of Object.keys(this.last)) {
      if (now - this.last[kind] >= kLongestHold) this.last[kind] = now;
    }
    this.isDue = false;
    this.isPosting = true;
    this.run = {begin: now, awaited: "layer", hasEnded: false};
    const choice = {...this.choose(), client: this.client, number: ++this.number};
    this.begin();
    try {
      const {status, body} = await this.transport.send("/change", choice);
      if (status !== 202) this.miss(choice, status, body);
    } catch {
      this.disconnect();
    }
    this.isPosting = false;
    this.pump();
  }

  // The program has not taken a choice.
  miss(choice, status, body) {
    if (status !== 404) {
      this.run.awaited = null;
      this.run.hasEnded = true;
      this.refuse(status, body);
    } else if (choice.client === this.client) {
      this.disconnect();
      this.transport.reopen();
    }
  }

  // Until the next `hello`, after which the choice is sent again.
  disconnect() {
    this.client = null;
    this.run = null;
    this.lose();
  }
}
