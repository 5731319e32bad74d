// Draws figures of a report as its page does, without a browser, and writes what came out as JSON.
//
//   node draw_page.js FIGURE.JS TASKS.JSON
//
// TASKS.JSON: {page: {colors, ...}, arrays: [...], figures: [{figure, top}, ...]}. The answer: for
// every figure {svg, boxes, cells}: a picture whose groups name the part of the drawing they are
// (data-part) and its panel (data-panel), the boxes of the panels, middles of the cells in pixels.

const fs = require("fs");
const vm = require("vm");

// mean width of letters over their size, as libio/drawing estimates it for names beside panels
const LETTER = 0.54, BOLD_LETTER = 0.66;

/** A canvas that keeps its pixels and guesses widths of texts. */
class Canvas {
  getContext() {
    return {
      font: "12px sans-serif",
      measureText(text) {
        const letter = this.font.startsWith("bold") ? BOLD_LETTER : LETTER;
        return { width: [...text].length * letter * Number(this.font.match(/([\d.]+)px/)[1]) };
      },
      createImageData: (width, height) => ({ width, height, data: new Uint8ClampedArray(4 * width * height) }),
      putImageData: (image) => (this.image = image),
    };
  }
  toDataURL() { return `pixels:${this.width}:${this.height}:${Array.from(this.image.data).join(",")}`; }
}

const [source, tasks] = process.argv.slice(2);
const task = JSON.parse(fs.readFileSync(tasks, "utf8"));
const context = vm.createContext({
  document: { createElement: () => new Canvas(), documentElement: { dataset: { theme: "light" } } },
  page: task.page, atob: (text) => Buffer.from(text, "base64").toString("latin1"),
});
vm.runInContext(fs.readFileSync(source, "utf8") + "\nthis.parts = { Arrays, Drawing, SvgContext };", context);
const { Arrays, Drawing, SvgContext } = context.parts;

// every part of the drawing in a group that says what it is
const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
for (const part of ["drawCells", "drawAxes", "drawColorBar", "drawRules", "drawLine", "drawMarkers", "drawEndNames", "drawLabel", "drawLegend"]) {
  const draw = Drawing.prototype[part];
  Drawing.prototype[part] = function (ctx, panel, what, ...more) {
    const name = what && typeof what === "object" ? what.name || what.end_name || "" : "";
    ctx.body.push(`<g data-part="${part}" data-panel="${this.panels.indexOf(panel)}" data-name="${escaped(name)}">`);
    const result = draw.call(this, ctx, panel, what, ...more);
    ctx.body.push("</g>");
    return result;
  };
}

const arrays = new Arrays(task.arrays);
const answers = task.figures.map(({ figure, top }) => {
  const drawing = new Drawing(figure, arrays);
  const ctx = new SvgContext(figure.width, figure.height);
  drawing.draw(ctx, figure.width, figure.height, top);
  drawing.drawLegend(ctx, figure.width, figure.height);
  return {
    svg: ctx.document(),
    boxes: drawing.panels.map((p) => [p.box.x, p.box.y, p.box.w, p.box.h]),
    cells: drawing.panels.map((p) => p.cells
      ? Array.from(p.cells.y).flatMap((y) => Array.from(p.cells.x).map((x) => [drawing.px(p, x), drawing.py(p, y)])) : []),
  };
});
process.stdout.write(JSON.stringify(answers));
