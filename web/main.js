// Puts the page together.

const page = JSON.parse(document.getElementById("data").textContent);
const arrays = new Arrays(page.arrays);

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  for (const view of views) {
    view.makeLegend();
    if (view.isDrawn) view.draw();
  }
  for (const space of spaces) space.recolor();
}

/** One card per kind of figure, in the order of the program. */
function kindsOf(result) {
  const kinds = new Map();
  for (const f of result.figures) kinds.set(f.kind, [...(kinds.get(f.kind) || []), f]);
  return [...kinds.values()];
}

/** A part of the page that fails says so and leaves the others alone. */
function attempt(what, place, make) {
  try {
    return make();
  } catch (error) {
    place.append(element("div", { class: "warning", role: "alert" }, `no figure "${what}": ${error.message || error}`));
    return null;
  }
}

const warningsOf = (result) => result.warnings.map((w) => element("div", { class: "warning", role: "alert" }, w));

/** A table of names and values. */
function factsTable(facts) {
  const rows = (Array.isArray(facts) ? facts : []).map(([k, v]) => element("tr", {}, element("td", {}, k), element("td", {}, k === "command" ? element("code", {}, v) : v)));
  return element("div", { class: "scroll" }, element("table", { class: "facts" }, ...rows));
}

/** A card of names and values, with what more is to be said below. */
function factsCard(id, title, facts, ...more) {
  return element("article", { class: "card facts-card", id }, element("h3", {}, title), factsTable(facts), ...more);
}

/** The tables that a printed report has of a result. */
const sheetsOf = (sheets) => !sheets.length ? [] : [element("details", { class: "sheets" }, element("summary", {}, "tables"),
  ...sheets.flatMap(({ caption, header, rows, notes }) =>
    [element("h4", {}, caption), tableOf(header, rows), ...notes.map((note) => element("p", { class: "notes" }, note))]))];
const modelText = (text) => element("details", {}, element("summary", {}, "model file"), element("pre", {}, text));

/** The figures of a result as cards, and what moves in space after its layout, or last. */
function addFigures(result, grid, link) {
  for (const figures of kindsOf(result)) {
    const { subject, heading: name } = figures[0];
    const view = attempt(name, grid, () => new FigureView(figures, result, arrays));
    if (!view) continue;
    grid.append(view.card);
    link(view.card.id, name);
    if (subject === "rotor" && result.motion.motions && !page.machine) addSpace(result, grid, link);
  }
  if (result.motion.motions && !spaces.some((s) => s.result === result)) addSpace(result, grid, link);
}

/** Results of one machine: its drawing first, then a section per analysis. */
function addMachine(main, contents) {
  const { machine, results } = page;
  const link = (id, name) => contents.append(element("a", { href: `#${id}` }, name));
  const grid = element("div", { class: "grid" });
  grid.append(factsCard("facts-machine", "The machine", machine.facts, modelText(machine.model)));
  main.append(element("section", {}, grid));
  const drawing = { number: "machine", figures: machine.figures, motion: {}, warnings: [] };
  addFigures(drawing, grid, link);
  results.forEach((result, number) => {
    result.number = number;
    const own = element("div", { class: "grid" }), heading = element("h2", { id: `analysis-${number}` }, result.heading);
    const more = result.contacts.rows ? [tableOf(result.contacts.header, result.contacts.rows)] : [];
    main.append(element("section", {}, heading, ...warningsOf(result), own));
    link(heading.id, result.heading);
    addFigures(result, own, () => {});
    own.append(factsCard(`facts-${number}`, "How it was computed", result.facts, ...more, ...sheetsOf(result.sheets)));
  });
}

/** Each result by itself. */
function addResults(main, contents) {
  page.results.forEach((result, number) => {
    result.number = number;
    const several = page.results.length > 1;
    const section = element("section", {});
    if (several) section.append(element("h2", {}, `${result.title} (${result.path})`));
    section.append(...warningsOf(result));
    const grid = element("div", { class: "grid" });
    const more = result.contacts.rows ? [tableOf(result.contacts.header, result.contacts.rows)] : [];
    grid.append(factsCard(`facts-${number}`, "Facts", result.facts, ...more, ...sheetsOf(result.sheets), modelText(result.model)));
    section.append(grid);
    main.append(section);
    addFigures(result, grid, (id, name) => contents.append(element("a", { href: `#${id}` }, several ? `${number + 1} ${name}` : name)));
  });
}

/** Pictures for paper take the place of what is drawn for the screen. */
function listenToPrinter() {
  const cards = () => [...views, ...spaces];
  addEventListener("beforeprint", () => {
    const theme = document.documentElement.dataset.theme;
    if (theme === "dark") setTheme("light");
    printedFrom = theme;
    for (const card of cards()) attempt("on paper", card.card, () => card.prepareToPrint());
  });
  addEventListener("afterprint", () => {
    for (const card of cards()) card.endPrint();
    if (printedFrom === "dark") setTheme("dark");
  });
}
let printedFrom = "light";

/** Whose report it is, in one line: what the cover of a printed one says at length. */
function coverLine() {
  const lines = new Map(page.cover.lines);
  const parts = ["Company", "Project", "Document", "Revision", "Author", "Date"].map((name) => [name, lines.get(name)]);
  return parts.filter(([, value]) => value).map(([name, value]) => (name === "Revision" ? `revision ${value}` : value)).join(" · ");
}

function build() {
  const wanted = matchMedia("(prefers-color-scheme: dark)");
  document.documentElement.dataset.theme = wanted.matches ? "dark" : "light";
  wanted.addEventListener("change", (e) => setTheme(e.matches ? "dark" : "light"));
  const first = page.results[0], compared = page.comparison;
  document.getElementById("head").append(
    element("div", {}, element("h1", {}, compared ? compared.names.join(", ") : page.cover.title), element("p", {}, `report of whirl ${page.version}`),
      element("details", { class: "cover" }, element("summary", {}, coverLine()), factsTable(page.cover.lines))),
    element("button", { type: "button", id: "theme", onclick: () => setTheme(isDark() ? "light" : "dark") }, "Light / dark"));

  const contents = element("div"), main = document.getElementById("main");
  document.getElementById("contents").append(contents);
  if (compared) addComparison(compared, main, contents);
  if (page.machine) addMachine(main, contents);
  else addResults(main, contents);
  listenToPrinter();

  // what is seen first is drawn first, the rest while nobody waits
  const waiting = [...views];
  const drawSome = () => {
    const start = performance.now();
    while (waiting.length && performance.now() - start < 30) {
      const view = waiting.shift();
      attempt(view.figure.heading, view.card, () => view.draw());
    }
    if (waiting.length) setTimeout(drawSome, 0);
    else document.documentElement.dataset.state = "drawn";
  };
  drawSome();
  let timer = 0;
  addEventListener("resize", () => {
    clearTimeout(timer);
    timer = setTimeout(() => views.forEach((v) => v.resize()), 80);
  });
}

/** Figures of several results over each other, and what their models differ in. */
function addComparison(compared, main, contents) {
  const grid = element("div", { class: "grid" }), { header, rows } = compared.differences;
  const section = element("section", {}, element("h2", {}, `Compared: ${compared.names.join(", ")}`), grid);
  grid.append(element("article", { class: "card wide", id: "differences" }, element("h3", {}, "Differences of the models"),
    rows.length ? tableOf(header, rows) : element("p", { class: "about" }, "none")));
  contents.append(element("a", { href: "#differences" }, "differences"));
  const result = { number: "compared", figures: compared.figures };
  for (const figures of kindsOf(result)) {
    const view = attempt(figures[0].kind, grid, () => new FigureView(figures, result, arrays));
    if (!view) continue;
    grid.append(view.card);
    contents.append(element("a", { href: `#${view.card.id}` }, `compared ${figures[0].heading}`));
  }
  main.append(section);
}

function addSpace(result, grid, link) {
  const space = new SpaceView(result, arrays);
  grid.append(space.card);
  link(space.card.id, "In space");
}

build();
