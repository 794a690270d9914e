// The map: a plane of metres, x to the right, y up.
import { by_id } from "./dom.js";

const kEdge_px = 12;

export const map = L.map("map", {
  crs: L.CRS.Simple,
  attributionControl: false,
  zoomControl: false,
  zoomSnap: 0,  // a map fits exactly
  zoomDelta: 0.5,
  wheelPxPerZoomLevel: 120,
  minZoom: -2,
  maxZoom: 8,
  maxBoundsViscosity: 0.7,
  keyboard: true,
  tap: false,
  bounceAtZoomLimits: false,
});
map.setView([0, 0], 4, { animate: false });

// From the ground up; Leaflet's own panes for markers lie above them.
for (const [name, height] of [["ground", 210], ["probability", 220], ["searched", 230], ["areas", 410], ["paths", 420],
  ["sensors", 430], ["agents", 640], ["handles", 660]]) {
  map.createPane(name).style.zIndex = height;
}
for (const name of ["paths", "sensors"]) map.getPane(name).style.pointerEvents = "none";

export const renderers = Object.fromEntries(
  ["areas", "paths", "sensors"].map((name) => [name, L.svg({ pane: name, padding: 0.5 })]));

export function at([x, y]) {
  return L.latLng(y, x);
}

export function corners(polygon) {
  return polygon.map(at);
}

export function pixels_per_metre() {
  return map.getZoomScale(map.getZoom(), 0);
}

/// Where a pointer is, in metres.
export function place_of(event) {
  const place = map.mouseEventToLatLng(event);
  return [place.lng, place.lat];
}

let shown = "";

/// A new map is shown whole.
export function fit_map(size) {
  const wanted = `${size.width_m} ${size.height_m}`;
  if (shown === wanted) return;
  shown = wanted;
  const bounds = L.latLngBounds([0, 0], [size.height_m, size.width_m]);
  refit = () => {
    const buttons_px = by_id("map-buttons").offsetWidth;
    map.fitBounds(bounds, {
      paddingTopLeft: [kEdge_px, kEdge_px], paddingBottomRight: [buttons_px > 0 ? buttons_px + 2 * kEdge_px : kEdge_px, kEdge_px], animate: false });
  };
  touched = false;
  map.setMaxBounds(null);  // of the map before
  refit();
  map.setMaxBounds(bounds.pad(0.35));  // after it, or it pans there from elsewhere
}

let refit = () => {};
let touched = false;

/// The whole map again.
export function show_whole() {
  touched = false;
  refit();
}

map.on("dragstart", () => { touched = true; });
map.getContainer().addEventListener("wheel", () => { touched = true; }, { passive: true });
map.getContainer().addEventListener("pointerdown", (event) => { if (!event.isPrimary) touched = true; });

export function zoom_by(steps) {
  touched = true;
  map.setZoom(map.getZoom() + steps);
}

// A screen that turns, or a panel that opens, keeps the whole map in sight until somebody has moved it.
new ResizeObserver(() => {
  map.invalidateSize({ animate: false });
  if (!touched) refit();
}).observe(by_id("map"));
