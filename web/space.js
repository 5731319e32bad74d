// What moves, in space: shaft and disks with true diameters, symbols of disks without, stators, touches and trails. The shaft's axis is z, drawn to
// the right; y is up. Displacements, and clearances with them, are enlarged by one scale.

const spaces = [];

class SpaceView {
  constructor(result, arrays) {
    this.result = result;
    this.data = result.motion;
    this.motions = this.data.motions.map((m) => ({ ...m }));
    for (const m of this.motions) {
      for (const key of ["times", "places", "forces", "re", "im"]) if (m[key] !== undefined) m[key] = arrays.get(m[key]);
    }
    this.points = this.data.z.length;
    this.isPlaying = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.at = 0;  // frame, or phase in turns
    this.build();
    spaces.push(this);
  }

  build() {
    this.host = element("div", { class: "space" });
    const range = (name, attributes, run) => {
      const input = element("input", { type: "range", "aria-label": name, ...attributes, oninput: () => run(Number(input.value)) });
      return input;
    };
    this.playButton = element("button", { type: "button", onclick: () => {
      this.isPlaying = !this.isPlaying;
      this.showPlaying();
      this.wake();
    } });
    this.scrub = range("moment", { min: 0, max: 1, step: 0.001, value: 0 }, (v) => {
      this.isPlaying = false;
      this.showPlaying();
      this.at = v * this.length;
      this.show();
    });
    this.speed = range("speed", { min: -2, max: 2, step: 0.05, value: 0 }, () => {});
    this.scaleInput = range("scale", { min: -2, max: 1.3, step: 0.02, value: 0 }, () => { this.trails = null; this.show(); });
    this.scaleText = element("span");
    this.moment = element("span");
    this.select = element("select", { onchange: () => this.choose(Number(this.select.value)) },
      ...this.motions.map((m, i) => element("option", { value: i }, m.name)));
    const camera = (name, direction) => element("button", { type: "button", onclick: () => this.look(direction) }, name);
    this.message = element("p", { class: "notes" });
    this.card = element("article", { class: "card wide", id: `space-${this.result.number}` },
      element("div", { class: "top" }, element("div", {}, element("h3", {}, "In space")),
        element("div", { class: "tools" }, this.select, camera("Oblique", [-0.75, 0.42, 0.9]), camera("Side", [0, 0, 1]), camera("Along the axis", [1, 0.0001, 0]), camera("Top", [0, 1, 0.0001]),
          element("button", { type: "button", onclick: () => this.savePng() }, "PNG"))),
      this.host,
      element("div", { class: "play" }, this.playButton, element("label", { class: "scrub" }, this.scrub), this.moment,
        element("label", {}, "speed", this.speed), element("label", {}, "scale", this.scaleInput, this.scaleText)),
      this.message);
    this.showPlaying();
    // built when it is seen first: the plots come before it
    const watch = new IntersectionObserver((entries) => {
      this.isSeen = entries[entries.length - 1].isIntersecting;
      if (this.isSeen && !this.scene && !this.hasFailed) this.start();
      this.wake();
    });
    watch.observe(this.host);
    addEventListener("resize", () => this.resize());
  }

  showPlaying() { this.playButton.textContent = this.isPlaying ? "Pause" : "Play"; }

  start() {
    try {
      this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      this.hasFailed = true;
      this.message.textContent = "This browser draws nothing in space (no WebGL).";
      return;
    }
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.host.append(this.renderer.domElement);
    this.scene = new three.Scene();
    this.camera = new three.PerspectiveCamera(32, 1, 0.01, 100);
    this.controls = new three.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableZoom = true;
    this.controls.addEventListener("change", () => this.wake());
    this.scene.add(new three.HemisphereLight(0xffffff, 0x99a5b2, 2.4));
    const sun = new three.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-1, 2, 2.5);
    this.scene.add(sun);
    this.makeBodies();
    this.choose(0);
    this.resize();
    this.look([-0.75, 0.42, 0.9]);
  }

  // a turn of the model, no mirror image: z to the right, y up, x away from the eye
  set(array, i, x, y, z) {
    array[3 * i] = (z - this.middle) / this.size;
    array[3 * i + 1] = y / this.size;
    array[3 * i + 2] = -x / this.size;
  }

  makeBodies() {
    const { z, shaft, disks, stators, supports } = this.data;
    const first = Math.min(...z), last = Math.max(...z);
    const radius = Math.max(1e-6, ...disks.map((d) => d.outer), ...stators.map((s) => s.radius), ...shaft.map((p) => p.left_radius), ...supports.map((s) => s.foot));
    this.middle = 0.5 * (first + last);
    this.size = Math.max(last - first, 2 * radius);  // of the drawing: one unit
    const clear = Math.max(0, ...stators.map((s) => 1.2 * s.radius)) / this.size;
    this.radius = Math.max(radius / this.size, clear) + 0.14;  // of what moves, in units of the drawing
    this.length3 = (last - first) / this.size;
    this.meshes = [];
    for (const piece of shaft) this.addPiece(piece);
    for (const disk of disks) this.addDisk(disk);
    this.stators = stators.map((s, i) => this.addStator(s, i));
    for (const s of supports) this.addSupport(s);
    this.addRestLine(first - 0.04 * this.size, last + 0.04 * this.size);
    // trails of disks and contacts
    this.trailPoints = [...new Set([...disks.map((d) => d.point), ...stators.map((s) => s.rotor)])];
    this.trailLines = this.trailPoints.map(() => this.addTrail());
  }

  /** A body of rings with as many facets each, whose corners a function places; closed: the last ring meets the first;
   *  broken: of every other sector only. */
  addRings(rings, facets, isClosed, paintName, options, place, isBroken = false) {
    const geometry = new three.BufferGeometry(), n = rings * facets;
    const positions = new three.BufferAttribute(new Float32Array(3 * n), 3);
    positions.setUsage(three.DynamicDrawUsage);
    geometry.setAttribute("position", positions);
    const index = [], last = isClosed ? rings : rings - 1;
    for (let r = 0; r < last; ++r) {
      const next = (r + 1) % rings;
      for (let f = 0; f < facets; ++f) {
        const g = (f + 1) % facets;
        if (isBroken && Math.floor((24 * f) / facets) % 2 === 1) continue;
        index.push(r * facets + f, next * facets + f, next * facets + g, r * facets + f, next * facets + g, r * facets + g);
      }
    }
    geometry.setIndex(index);
    const material = new three.MeshStandardMaterial({ color: new three.Color(paint(paintName)), roughness: 0.55, metalness: 0.15, side: three.DoubleSide, flatShading: false, ...options });
    const mesh = new three.Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
    const entry = { mesh, positions, place, paintName, facets };
    this.meshes.push(entry);
    return entry;
  }

  addPiece(piece) {
    const facets = 24, parts = 5;
    this.addRings(parts + 1, facets, false, "shaft", {}, (array) => {
      for (let s = 0; s <= parts; ++s) {
        const q = this.between(piece, s / parts), r = piece.left_radius + (s / parts) * (piece.right_radius - piece.left_radius);
        for (let f = 0; f < facets; ++f) this.around(array, s * facets + f, q, r, (2 * Math.PI * f) / facets, 0);
      }
    });
  }

  addDisk(disk) {
    const facets = 72, isSymbol = disk.not_given !== undefined;
    const ring = [[disk.inner, -0.5], [disk.outer, -0.5], [disk.outer, 0.5], [disk.inner, 0.5]];
    const options = isSymbol ? { flatShading: true, transparent: true, opacity: 0.6 } : { flatShading: true };
    this.addRings(4, facets, true, "disk", options, (array) => {
      const q = this.state(disk.point);
      ring.forEach(([r, side], s) => {
        for (let f = 0; f < facets; ++f) this.around(array, s * facets + f, q, r, (2 * Math.PI * f) / facets, side * disk.width);
      });
    }, isSymbol);
  }

  /** A bearing, or the spring below what carries one: a pyramid on a plate. Its tip moves with what is above, its foot with
   *  what carries it. */
  addSupport(s) {
    const half = 0.5 * s.width, corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
    const under = () => (s.to >= 0 ? this.state(s.to) : { x: 0, y: 0 });
    this.addRings(2, 4, false, "bearing", { flatShading: true }, (array) => {
      const above = this.state(s.from), foot = under();
      corners.forEach(([a, b], f) => {
        this.set(array, f, above.x, above.y - s.tip, s.z);
        this.set(array, 4 + f, foot.x + a * half, foot.y - s.foot, s.z + b * half);
      });
    });
    this.addRings(2, 4, false, "rest", { flatShading: true }, (array) => {
      const foot = under();
      corners.forEach(([a, b], f) => {
        this.set(array, f, foot.x, foot.y - s.foot, s.z);
        this.set(array, 4 + f, foot.x + 1.6 * a * half, foot.y - s.foot, s.z + 1.6 * b * half);
      });
    });
  }

  /** A stator with the flash where it is touched. */
  addStator(s, number) {
    const facets = 64, width = 0.16 * s.radius;
    const entry = this.addRings(4, facets, true, "stator", { transparent: true, opacity: 0.45, depthWrite: false }, (array) => {
      const base = s.point >= 0 ? this.state(s.point) : { x: 0, y: 0, tx: 0, ty: 0, z: s.z };
      const scale = this.scale, inner = s.radius + scale * s.clearance, outer = inner + width;
      const q = { x: base.x + scale * s.x, y: base.y + scale * s.y, tx: 0, ty: 0, z: s.z };
      const half = Math.max(0.12 * s.radius, 0.012 * this.size);
      [[inner, -half], [outer, -half], [outer, half], [inner, half]].forEach(([r, dz], k) => {
        for (let f = 0; f < facets; ++f) {
          const angle = (2 * Math.PI * f) / facets;
          if (!s.direction) {
            const wider = s.reach ? scale * (s.reach[f] - s.clearance) : 0; // where the wall is no circle
            this.around(array, k * facets + f, q, r + wider, angle, dz);
            continue;
          }
          // a plate: there and back along the line that is r away
          const [nx, ny] = s.direction, along = s.radius * Math.cos(angle);
          this.set(array, k * facets + f, q.x + r * nx - along * ny, q.y + r * ny + along * nx, q.z + dz);
        }
      });
    });
    const flash = new three.Mesh(new three.SphereGeometry(0.018, 20, 12), new three.MeshBasicMaterial({ color: new three.Color(paint("alarm")) }));
    flash.visible = false;
    this.scene.add(flash);
    return { ...s, number, entry, flash };
  }

  /** The line of the shaft at rest, between two places along it. */
  addRestLine(from, to) {
    const rest = new three.BufferGeometry(), ends = new Float32Array(6);
    this.set(ends, 0, 0, 0, from);
    this.set(ends, 1, 0, 0, to);
    rest.setAttribute("position", new three.BufferAttribute(ends, 3));
    this.restLine = new three.Line(rest, new three.LineDashedMaterial({ color: new three.Color(paint("gray")), dashSize: 0.02, gapSize: 0.012 }));
    this.restLine.computeLineDistances();
    this.scene.add(this.restLine);
  }

  addTrail() {
    const line = new three.Line(new three.BufferGeometry(), new three.LineBasicMaterial({ color: new three.Color(paint("alarm")) }));
    line.frustumCulled = false;
    line.renderOrder = 2;
    line.material.depthTest = false;
    this.scene.add(line);
    return line;
  }

  /** Displacement of a point of the scene now, enlarged. */
  state(point) {
    const n = this.now, k = 4 * point, s = this.scale;
    return { x: s * n[k], y: s * n[k + 1], tx: s * n[k + 2], ty: s * n[k + 3], z: this.data.z[point] };
  }

  /** Between two points of the shaft: the cubic with their tilts as slopes, x' = theta_y, y' = -theta_x. */
  between(piece, u) {
    const a = this.state(piece.left), b = this.state(piece.right), l = b.z - a.z;
    const h = [1 - 3 * u * u + 2 * u ** 3, u - 2 * u * u + u ** 3, 3 * u * u - 2 * u ** 3, u ** 3 - u * u];
    return { x: h[0] * a.x + h[1] * l * a.ty + h[2] * b.x + h[3] * l * b.ty,
      y: h[0] * a.y - h[1] * l * a.tx + h[2] * b.y - h[3] * l * b.tx,
      tx: a.tx + u * (b.tx - a.tx), ty: a.ty + u * (b.ty - a.ty), z: a.z + u * l };
  }

  /** A point at arm (r cos, r sin, dz) of a body that is displaced and tilted: u + theta x arm. */
  around(array, i, q, r, angle, dz) {
    const ax = r * Math.cos(angle), ay = r * Math.sin(angle);
    this.set(array, i, q.x + ax + q.ty * dz, q.y + ay - q.tx * dz, q.z + dz + q.tx * ay - q.ty * ax);
  }

  choose(number) {
    this.motion = this.motions[number];
    const m = this.motion;
    this.now = new Float64Array(4 * this.points);
    this.at = 0;
    this.length = m.kind === "motion" ? m.times.length : 1;
    // the largest displacement is drawn as 12 % of the size, tilts no larger than 0.35 rad
    let far = 0, tilt = 0;
    const see = (values, other) => {
      for (let i = 0; i < values.length; i += 4) {
        const size = (k) => other ? Math.hypot(values[i + k], other[i + k]) : Math.abs(values[i + k]);
        far = Math.max(far, Math.hypot(size(0), size(1)));
        tilt = Math.max(tilt, size(2), size(3));
      }
    };
    if (m.kind === "motion") see(m.places);
    else see(m.re, m.im);
    this.fit = Math.min(far > 0 ? (0.12 * this.size) / far : 1, tilt > 0 ? 0.35 / tilt : Infinity);
    if (m.kind === "motion") this.fit = Math.max(1, this.fit);
    this.message.textContent = m.kind === "motion"
      ? "Drag to turn, wheel to zoom, right button to move. The line after each disk and contact is its path; a stator lights up while it is touched."
      : `${m.about} Paths are its orbits. Drag to turn, wheel to zoom, right button to move.`;
    this.message.textContent += this.stators.length > 0 ? " Lengths and thicknesses of stators are symbols." : "";
    this.message.textContent += this.data.supports.length > 0 ? " Pyramids are bearings and springs, not to scale." : "";
    if (this.data.symbols) this.message.textContent += ` ${this.data.symbols}.`;
    this.trails = null;
    this.show();
    this.wake();
  }

  get scale() { return this.fit * 10 ** Number(this.scaleInput.value); }

  fill(at, out) {
    const m = this.motion, n = 4 * this.points;
    if (m.kind === "mode") {
      const c = Math.cos(2 * Math.PI * at), s = Math.sin(2 * Math.PI * at);
      for (let i = 0; i < n; ++i) out[i] = m.re[i] * c - m.im[i] * s;
    } else {
      const frame = Math.min(this.length - 1, Math.floor(at)), next = Math.min(this.length - 1, frame + 1), share = at - frame;
      for (let i = 0; i < n; ++i) {
        const a = m.places[frame * n + i], b = m.places[next * n + i];
        out[i] = a + Math.max(0, Math.min(1, share)) * (b - a);
      }
    }
  }

  makeTrail(k) {
    const point = this.trailPoints[k], m = this.motion, count = m.kind === "mode" ? 97 : 2 * Math.round(m.samples) + 1;
    const places = new Float32Array(3 * count), held = this.now, s = this.scale;
    if (m.kind === "mode") {
      this.now = new Float64Array(held.length);
      for (let j = 0; j < count; ++j) {
        this.fill(j / 96, this.now);
        const q = this.state(point);
        this.set(places, j, q.x, q.y, q.z);
      }
    } else {  // the last two revolutions before now
      const n = 4 * this.points, frame = Math.floor(this.at);
      for (let j = 0; j < count; ++j) {
        const f = Math.max(0, Math.min(this.length - 1, frame - (count - 1) + j)), i = f * n + 4 * point;
        this.set(places, j, s * m.places[i], s * m.places[i + 1], this.data.z[point]);
      }
    }
    this.now = held;
    return places;
  }

  show() {
    if (!this.scene) return;
    const m = this.motion;
    this.fill(this.at, this.now);
    for (const { mesh, positions, place } of this.meshes) {
      place(positions.array);
      positions.needsUpdate = true;
      mesh.geometry.computeVertexNormals();
    }
    const frame = Math.min(this.length - 1, Math.floor(this.at));
    for (const s of this.stators) {
      const touches = m.kind === "motion" && m.forces.length > 0 && m.forces[frame * this.stators.length + s.number] > 0;
      s.entry.mesh.material.color.set(paint(touches ? "alarm" : "stator"));
      s.entry.mesh.material.opacity = touches ? 0.75 : 0.45;
      s.flash.visible = touches;
      if (touches) {
        const q = this.state(s.rotor), base = s.point >= 0 ? this.state(s.point) : { x: 0, y: 0 };
        const dx = q.x - base.x - this.scale * s.x, dy = q.y - base.y - this.scale * s.y, far = Math.hypot(dx, dy) || 1;
        const [nx, ny] = s.direction ?? [dx / far, dy / far];
        const place = new Float32Array(3);
        this.set(place, 0, q.x + s.radius * nx, q.y + s.radius * ny, s.z);
        s.flash.position.set(...place);
      }
    }
    if (!this.trails || m.kind === "motion") {
      this.trails = this.trailLines.map((line, k) => {
        const places = this.makeTrail(k), old = line.geometry.getAttribute("position");
        if (old && old.array.length === places.length) {
          old.array.set(places);
          old.needsUpdate = true;
        } else {
          line.geometry.dispose();
          line.geometry = new three.BufferGeometry();
          line.geometry.setAttribute("position", new three.BufferAttribute(places, 3));
        }
        line.material.color.set(paint(m.kind === "mode" ? (m.whirl === "forward" || m.whirl === "backward" ? m.whirl : "mixed") : "alarm"));
        return true;
      });
    }
    this.scrub.value = this.at / this.length;
    this.moment.textContent = m.kind === "motion"
      ? `t = ${m.times[frame].toFixed(4)} s, revolution ${((frame - this.length + 1) / m.samples).toFixed(2).replace("-", "−")}`
      : `phase ${Math.round(360 * (this.at % 1))}°`;
    this.scaleText.textContent = `${shown(this.scale, 3)} : 1`;
    this.render();
  }

  render() {
    this.renderer.render(this.scene, this.camera);
    this.frames = (this.frames || 0) + 1;
    this.host.dataset.frames = this.frames;
  }

  /** Goes on drawing while it plays and is seen. */
  wake() {
    if (!this.scene || this.isAwake) return;
    this.isAwake = true;
    let last = performance.now();
    const step = (now) => {
      const passed = Math.max(0, Math.min(0.1, (now - last) / 1000));
      last = now;
      this.controls.update();
      if (this.isPlaying && this.isSeen) {
        // a revolution or cycle in four seconds at the middle of the slider
        const rate = 0.25 * 10 ** (0.5 * Number(this.speed.value));
        const m = this.motion;
        this.at += passed * rate * (m.kind === "motion" ? m.samples : 1);
        if (this.at >= this.length) this.at = m.kind === "motion" ? 0 : this.at % 1;
        this.show();
        requestAnimationFrame(step);
      } else {
        this.isAwake = false;
        this.render();
      }
    };
    requestAnimationFrame(step);
  }

  look(direction) {
    const d = new three.Vector3(...direction).normalize();
    const half = Math.tan((this.camera.fov * Math.PI) / 360);  // all fits, whatever the shape of the window
    const far = Math.max((1.08 * this.radius + 0.05 * this.length3) / half, (0.55 * this.length3 + 0.6 * this.radius) / half / this.camera.aspect);
    this.camera.position.copy(d.multiplyScalar(far));
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.wake();
  }

  resize() {
    if (!this.renderer) return;
    const { clientWidth: w, clientHeight: h } = this.host;
    if (!w) return;
    this.renderer.setSize(w, h);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.wake();
  }

  /** A still picture on white paper. */
  prepareToPrint() {
    if (!this.scene && !this.hasFailed) this.start();
    if (!this.scene) return;
    const held = { moment: this.at, width: this.host.clientWidth, height: this.host.clientHeight };
    if (!held.width || !held.height) [held.width, held.height] = [900, 460];
    this.renderer.setSize(held.width, held.height);
    this.camera.aspect = held.width / held.height;
    this.camera.updateProjectionMatrix();
    this.recolor();
    this.paper = element("img", { class: "paper", alt: "the motion in space", src: this.renderer.domElement.toDataURL() });
    this.host.append(this.paper);
  }
  endPrint() {
    this.paper?.remove();
    this.paper = null;
    this.resize();
  }

  recolor() {
    if (!this.scene) return;
    for (const { mesh, paintName } of this.meshes) mesh.material.color.set(paint(paintName));
    this.restLine.material.color.set(paint("gray"));
    this.show();
  }

  savePng() {
    if (!this.scene) return;
    this.render();
    this.renderer.domElement.toBlob((blob) => save("space.png", blob));
  }
}
