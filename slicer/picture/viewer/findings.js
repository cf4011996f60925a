// The list of what was found in the print.

const kListedPlaces = 200;   // of a kind

const rangeText = ({first, last}) => first === last ? `${first}` : `${first}–${last}`;

// Items by what keyOf() says of them, in the order of the first ones.
function groupBy(items, keyOf) {
  const groups = new Map();
  for (const item of items) {
    const key = keyOf(item);
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(item);
  }
  return groups;
}

function make(name, text = "") {
  const element = document.createElement(name);
  element.textContent = text;
  return element;
}

// Lists what was found by kind, and what one line of the design made as one.
class FindingList {
  // visit(place) is called where the reader chooses one.
  constructor(element, visit) {
    this.element = element;
    this.visit = visit;
  }

  show({found, minFeature}) {
    const list = this.element;
    const seen = list.scrollTop;
    const kinds = groupBy(found.places, ({kind}) => kind);
    const heading = make("h2", found.places.length > 0 ? word("findings") :
      found.hasPrint ? word("noProblems") : word("nothingThinner", minFeature));
    list.replaceChildren(heading,
        ...[...kinds].flatMap(([kind, places]) => this.listKind(kind, places, minFeature)),
        ...found.notes.map((note) => make("p", note)));
    list.scrollTop = seen;
  }

  listKind(kind, places, minFeature) {
    const isThin = kind === "wall" || kind === "gap";
    const heading = make("h3");
    const dot = make("i");
    dot.style.background = `var(--${kind.replace(" ", "-")})`;
    const count = countOf(places.length, kind);
    heading.append(dot, isThin ? word("thinnerThan", count, minFeature) : count);
    const parts = [heading];
    const listed = places.slice(0, kListedPlaces);
    for (const [origin, ofOrigin] of groupBy(listed, (place) => place.origin)) {
      const rows = make("ol");
      rows.append(...ofOrigin.map((place) => this.listPlace(place)));
      if (origin && ofOrigin.length > 1) {
        const group = make("details");
        group.append(make("summary", word("placesOf", word("places", ofOrigin.length),
            isThin ? ofOrigin[0].text : word("ofLayer", rangeText(ofOrigin[0])))), rows);
        parts.push(group);
      } else {
        parts.push(rows);
      }
      if (origin) parts.push(make("em", origin));
    }
    if (listed.length < places.length) {
      parts.push(make("p", word("firstListed", kListedPlaces)));
    }
    return parts;
  }

  listPlace(place) {
    const item = make("li");
    const button = make("button");
    button.append(make("span", place.text), make("small", word("ofLayer", rangeText(place))));
    button.onclick = () => this.visit(place);
    item.append(button);
    return item;
  }
}
