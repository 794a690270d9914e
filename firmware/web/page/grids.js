// The pictures under everything: the ground by its classes or from the air, where the object probably is, what was searched.
import { map } from "./map.js";
import { model } from "./model.js";
import { view } from "./view_state.js";

// A canvas in place of the picture: it is painted anew without a flicker.
const CanvasOverlay = L.ImageOverlay.extend({
  _initImage() {
    const canvas = this._url;
    canvas.classList.add("leaflet-image-layer", "grid");
    if (this._zoomAnimated) canvas.classList.add("leaflet-zoom-animated");
    canvas.dataset.grid = this.options.name;
    this._image = canvas;
  },
});

const kFaded = 0.52;   // how far the ground steps back behind what is drawn on it
const kVeil = [255, 255, 255, 150];
// Light to deep violet, as in the pictures of `ivo`: even steps of lightness.
const kRamp = [[232, 214, 246], [205, 164, 236], [170, 108, 218], [126, 56, 184], [78, 18, 128]];
const kMostAlpha = 205;

const grids = {};  // by name: canvas, layer, revision that is painted

function layer_of(name, size) {
  const bounds = [[0, 0], [size.height_m, size.width_m]];
  if (!grids[name]) {
    const canvas = document.createElement("canvas");
    const pane = name === "map" || name === "aerial" ? "ground" : name;
    grids[name] = { canvas, layer: new CanvasOverlay(canvas, bounds, { pane, name }), revision: null };
  }
  const { layer } = grids[name];
  if (!layer.getBounds().equals(bounds)) layer.setBounds(bounds);  // another mission's
  return grids[name];
}

export function rgb_of(colour) {
  const value = parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

export function faded(colour) {
  return rgb_of(colour).map((value) => Math.round(value + kFaded * (255 - value)));
}

function paint(canvas, columns, rows, colour_of) {
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const to = 4 * ((rows - 1 - row) * columns + column);
      image.data.set(colour_of(row * columns + column), to);
    }
  }
  context.putImageData(image, 0, 0);
}

function paint_map(canvas, bytes, mission) {
  const colours = mission.classes.map((entry) => [...faded(entry.colour), 255]);
  const nothing = [255, 255, 255, 255];
  paint(canvas, mission.map.width_px, mission.map.height_px, (i) => colours[bytes[i]] ?? nothing);
}

function paint_probability(canvas, buffer, mission) {
  const { columns, rows } = mission.cells;
  const view_of = new DataView(buffer);
  const values = Float32Array.from({ length: columns * rows }, (_, i) => view_of.getFloat32(4 * i, true));
  const most = values.reduce((a, b) => Math.max(a, b), 0);
  const clear = [0, 0, 0, 0];
  paint(canvas, columns, rows, (i) => {
    const share = most > 0 ? Math.sqrt(values[i] / most) : 0;
    if (share < 0.08) return clear;
    const step = share * (kRamp.length - 1);
    const low = Math.min(Math.floor(step), kRamp.length - 2);
    const mix = kRamp[low].map((value, k) => value + (step - low) * (kRamp[low + 1][k] - value));
    return [...mix, Math.min(1, 1.6 * share) * kMostAlpha];
  });
}

function paint_searched(canvas, bytes, mission) {
  const { columns, rows } = mission.cells;
  const clear = [0, 0, 0, 0];
  paint(canvas, columns, rows, (i) => ((bytes[i >> 3] >> (i & 7)) & 1 ? kVeil : clear));
}

async function fetch_grid(name, revision, mission) {
  const grid = layer_of(name, mission.map);
  grid.revision = revision;
  try {
    const reply = await fetch(name === "aerial" ? "/aerial.png" : `/grid/${name}`, { cache: "no-store" });
    if (!reply.ok) throw new Error(String(reply.status));
    if (name === "aerial") {
      const picture = await createImageBitmap(await reply.blob());
      if (grid.revision !== revision) return;
      grid.canvas.width = picture.width;
      grid.canvas.height = picture.height;
      grid.canvas.getContext("2d").drawImage(picture, 0, 0);
      return;
    }
    const buffer = await reply.arrayBuffer();
    if (grid.revision !== revision) return;
    if (name === "map") paint_map(grid.canvas, new Uint8Array(buffer), mission);
    if (name === "probability") paint_probability(grid.canvas, buffer, mission);
    if (name === "searched") paint_searched(grid.canvas, new Uint8Array(buffer), mission);
  } catch {
    if (grid.revision === revision) grid.revision = null;  // asked for again with the next change
  }
}

function is_shown(name) {
  if (name === "map" || name === "aerial") return view.layers.ground === name;
  return view.layers[name];
}

export function show_grids() {
  const mission = model.documents.mission;
  if (!mission) return;
  for (const [name, number] of Object.entries(model.grids)) {
    const revision = `${model.connection}.${number}`;  // another server counts anew
    if (!["map", "aerial", "probability", "searched"].includes(name)) continue;
    const grid = layer_of(name, mission.map);
    if (grid.revision !== revision) fetch_grid(name, revision, mission);
    const on = map.hasLayer(grid.layer);
    if (is_shown(name) && !on) grid.layer.addTo(map);
    if (!is_shown(name) && on) grid.layer.remove();
  }
}

