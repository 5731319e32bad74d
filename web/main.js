// Puts the page together.

const page = JSON.parse(document.getElementById("data").textContent);
const arrays = new Arrays(page.arrays);

const NAMES = { layout: "Layout", campbell: "Campbell", log_decrement: "Log decrement", critical_map: "Critical speeds",
  modes: "Mode shapes", bode: "Bode", polar: "Polar", deflection: "Deflected shapes", orbit: "Orbit", time_history: "Time history",
  spectrum: "Spectrum", waterfall: "Waterfall", poincare: "Poincaré", contact_forces: "Contact forces", contact_angles: "Contact angles", mac: "MAC",
  exponents: "Exponents", bifurcation: "Bifurcation", branches: "Branches", borders: "Borders", torus: "Quasi-periodic", spectral_map: "Spectral map", cascade: "Cascade", map: "Map",
  exponent_map: "Exponent map", regime_map: "Contact map", basins: "Basins", work_precision: "Speed against error" };

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

function build() {
  const wanted = matchMedia("(prefers-color-scheme: dark)");
  document.documentElement.dataset.theme = wanted.matches ? "dark" : "light";
  wanted.addEventListener("change", (e) => setTheme(e.matches ? "dark" : "light"));
  const first = page.results[0], compared = page.comparison;
  document.getElementById("head").append(
    element("div", {}, element("h1", {}, compared ? compared.names.join(", ") : first.title), element("p", {}, `report of whirl ${page.version}`)),
    element("button", { type: "button", id: "theme", onclick: () => setTheme(isDark() ? "light" : "dark") }, "Light / dark"));

  const contents = element("div"), main = document.getElementById("main");
  document.getElementById("contents").append(contents);
  if (compared) addComparison(compared, main, contents);
  page.results.forEach((result, number) => {
    result.number = number;
    const several = page.results.length > 1;
    const section = element("section", {});
    if (several) section.append(element("h2", {}, `${result.title} (${result.path})`));
    for (const w of result.warnings) section.append(element("div", { class: "warning", role: "alert" }, w));
    const grid = element("div", { class: "grid" });
    const facts = element("article", { class: "card", id: `facts-${number}` }, element("h3", {}, "Facts"),
      element("div", { class: "scroll" }, element("table", { class: "facts" }, ...result.facts.map(([k, v]) =>
        element("tr", {}, element("td", {}, k), element("td", {}, k === "command" ? element("code", {}, v) : v))))));
    if (result.contacts.rows) facts.append(tableOf(result.contacts.header, result.contacts.rows));
    facts.append(element("details", {}, element("summary", {}, "model file"), element("pre", {}, result.model)));
    grid.append(facts);
    section.append(grid);
    main.append(section);
    const link = (id, name) => contents.append(element("a", { href: `#${id}` }, several ? `${number + 1} ${name}` : name));
    for (const figures of kindsOf(result)) {
      const view = new FigureView(figures, result, arrays);
      grid.append(view.card);
      link(view.card.id, NAMES[figures[0].kind] || figures[0].kind);
      if (figures[0].kind === "layout" && result.motion.motions) addSpace(result, grid, link);
    }
    if (result.motion.motions && !spaces.some((s) => s.result === result)) addSpace(result, grid, link);
  });

  // what is seen first is drawn first, the rest while nobody waits
  const waiting = [...views];
  const drawSome = () => {
    const start = performance.now();
    while (waiting.length && performance.now() - start < 30) waiting.shift().draw();
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
    const view = new FigureView(figures, result, arrays);
    grid.append(view.card);
    contents.append(element("a", { href: `#${view.card.id}` }, `compared ${NAMES[figures[0].kind] || figures[0].kind}`));
  }
  main.append(section);
}

function addSpace(result, grid, link) {
  const space = new SpaceView(result, arrays);
  grid.append(space.card);
  link(space.card.id, "In space");
}

build();
