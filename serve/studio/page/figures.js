// What the print weighs, takes and costs.

class Figures {
  // metal  the name of the chosen one; may be empty
  show(report, metal) {
    const {size, volume, estimate, metals} = report;
    byId("figures").hidden = false;
    byId("figures").classList.remove("old");
    byId("figure-size").textContent = sizeText(size);
    byId("figure-volume").textContent = word("mm3", fixed(volume, 2));
    byId("figure-estimate").textContent = estimate;
    byId("figure-estimate").hidden = !estimate;
    const chosen = metals.find(({name}) => name === metal);
    byId("weight-name").textContent = chosen ? chosen.title : word("weight");
    byId("weight").textContent = chosen ? word("grams", gramsText(chosen.grams)) : "";
    byId("figure-metals").replaceChildren(...metals.map(({title, grams}) => build("tr", {},
        build("th", {scope: "row", textContent: title}),
        build("td", {textContent: word("grams", gramsText(grams))}))));
  }

  // The figures are of what was shown before.
  dim() {
    byId("figures").classList.add("old");
  }
}

const sizeText = (size) => word("size", ...size.map((length) => fixed(length, 2)));

// As a goldsmith's scales show it.
const gramsText = (grams) => fixed(grams, grams < 100 ? 2 : 1);
