"use strict";
const token = new URLSearchParams(location.search).get("token");
const byId = (id) => document.getElementById(id);
const picture = byId("picture");
let scene = null; // cameras, target, up
let camera = null; // K, R, T, width, height
let shown = null; // the picture's bytes
let wanted = 0; // number of the last request
let newest = 0; // number of the request whose picture is shown
let stillTimer = 0;
const keys = []; // cameras of the path
const shownAt = []; // when the last pictures came, milliseconds
const thumbnails = new Map(); // promises of addresses by the number of the photograph

// ---- vectors of three numbers; matrices of nine, row by row ------------------------------------
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const add = (a, b, s) => a.map((value, i) => value + s * b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((value) => value / Math.sqrt(dot(a, a)));
const row = (m, i) => m.slice(3 * i, 3 * i + 3);
const column = (m, i) => [m[i], m[3 + i], m[6 + i]];
const times = (m, v) => [0, 1, 2].map((i) => dot(row(m, i), v));
const transposed = (m) => [0, 1, 2].flatMap((i) => column(m, i));
const product = (a, b) => [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => dot(row(a, i), column(b, j))));
const centreOf = (each) => times(transposed(each.R), each.T).map((value) => -value);
const centre = () => centreOf(camera);

function rotation(axis, angle) { // Rodrigues
  const [x, y, z] = axis, c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [c + x * x * d, x * y * d - z * s, x * z * d + y * s,
    y * x * d + z * s, c + y * y * d, y * z * d - x * s,
    z * x * d - y * s, z * y * d + x * s, c + z * z * d];
}

// ---- moving the camera -------------------------------------------------------------------------
function place(R, C) {
  camera.R = R;
  camera.T = times(R, C).map((value) => -value);
  moved();
}
function orbit(axis, angle) {
  const Q = rotation(axis, angle);
  const C = add(scene.target, times(Q, add(centre(), scene.target, -1)), 1);
  place(product(camera.R, transposed(Q)), C);
}
function drag(dx, dy) {
  orbit(scene.up, -dx * .01);
  orbit(row(camera.R, 0), -dy * .01);
}
function zoom(factor) {
  place(camera.R, add(scene.target, add(centre(), scene.target, -1), factor));
}
function pan(dx, dy) {
  const depth = dot(row(camera.R, 2), add(scene.target, centre(), -1));
  const shift = add(row(camera.R, 0).map((v) => -v * dx * depth / camera.K[0]),
    row(camera.R, 1), -dy * depth / camera.K[4]);
  const C = centre();
  scene.target = add(scene.target, shift, 1);
  place(camera.R, add(C, shift, 1));
}
function go(to) {
  camera = structuredClone(to);
  moved();
}
function snap(number) {
  const count = scene.cameras.length;
  byId("cameras").selectedIndex = (number + count) % count;
  go(scene.cameras[byId("cameras").selectedIndex]);
}

// ---- pictures ----------------------------------------------------------------------------------
// Pixel centres are at integers, so half a picture has its centre at (c + .5) / 2 - .5.
function halfSize() {
  const K = camera.K.map((value, i) => i === 8 ? 1 : value / 2);
  K[2] -= .25;
  K[5] -= .25;
  return { ...camera, K, width: Math.floor(camera.width / 2), height: Math.floor(camera.height / 2) };
}
function request(of, more) {
  const { K, R, T, width, height } = of;
  const body = JSON.stringify({ K, R, T, width, height, stage: byId("stage").value, show: byId("show").value, ...more });
  return fetch("/frame", { method: "POST", headers: { "X-Token": token }, body });
}
function tell(text) {
  byId("status").textContent = text;
}
function rate() {
  const now = performance.now();
  shownAt.push(now);
  while (shownAt[0] < now - 1000) shownAt.shift();
  return shownAt.length;
}
async function show(still) {
  const number = ++wanted;
  const start = performance.now();
  const answer = await request(still ? camera : halfSize(), {});
  if (answer.status === 409) return;
  if (!answer.ok) { tell(await answer.text()); return; }
  const blob = await answer.blob();
  if (number < newest || (number < wanted && still)) return;
  newest = number;
  if (shown) URL.revokeObjectURL(picture.src);
  shown = blob;
  picture.style.width = camera.width + "px";
  picture.src = URL.createObjectURL(blob);
  picture.dataset.still = still ? number : "";
  tell((still ? "still, " : "preview, ") + Math.round(performance.now() - start) + " ms, " + rate() + " per second");
}
function moved() {
  const ask = (still) => show(still).catch(() => tell("The program has ended."));
  ask(false);
  drawPanel();
  clearTimeout(stillTimer);
  stillTimer = setTimeout(() => ask(true), 250);
}
/** Orbits around the surface point under the pointer from now on. */
async function pick(event) {
  const box = picture.getBoundingClientRect();
  const at = [(event.clientX - box.left) * camera.width / box.width, (event.clientY - box.top) * camera.height / box.height]
    .map(Math.floor);
  const answer = await request(camera, { pick: at });
  const point = answer.headers.get("X-Point");
  if (!point) { tell("no surface there"); return; }
  scene.target = point.split(" ").map(Number);
  drawPanel();
  tell("pivot: " + point);
}

// ---- the panel beside the picture --------------------------------------------------------------
function nearestNumbers() {
  const to = unit(add(centre(), scene.target, -1));
  return scene.cameras.map((each, number) => ({ number,
    angle: Math.acos(Math.min(1, Math.max(-1, dot(to, unit(add(centreOf(each), scene.target, -1)))))) }))
    .sort((a, b) => a.angle - b.angle).slice(0, 3);
}
function thumbnail(number) {
  if (!thumbnails.has(number)) {
    thumbnails.set(number, fetch("/photograph?number=" + number, { headers: { "X-Token": token } })
      .then((answer) => answer.blob()).then((blob) => URL.createObjectURL(blob)));
  }
  return thumbnails.get(number);
}
function drawNearest(nearest) {
  const list = byId("nearest");
  while (list.children.length < nearest.length) {
    const button = list.appendChild(document.createElement("button"));
    button.append(Object.assign(document.createElement("img"), { alt: "" }), document.createElement("span"));
    button.addEventListener("click", () => snap(Number(button.dataset.number)));
  }
  nearest.forEach(({ number, angle }, i) => {
    const button = list.children[i];
    button.lastChild.textContent = scene.cameras[number].name + ", " + Math.round(angle * 180 / Math.PI) + "°";
    if (button.dataset.number === String(number)) return;
    button.dataset.number = number;
    thumbnail(number).then((url) => { if (button.dataset.number === String(number)) button.firstChild.src = url; });
  });
}
function svg(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
  return byId("rig").appendChild(element);
}
/** Seen from above, along the rig's up: the first photograph's right side is to the right. */
function drawRig(nearest) {
  const right = unit(add(row(scene.cameras[0].R, 0), scene.up, -dot(row(scene.cameras[0].R, 0), scene.up)));
  const down = cross(right, scene.up).map((value) => -value);
  const middle = scene.middle;
  const size = Math.max(...scene.cameras.map((each) => Math.sqrt(dot(add(centreOf(each), middle, -1), add(centreOf(each), middle, -1)))));
  const flat = (p) => { const d = add(p, middle, -1); return [dot(d, right) / size, dot(d, down) / size]; };
  const mark = (each, attributes) => {
    const [x, y] = flat(centreOf(each));
    const axis = row(each.R, 2);
    const [dx, dy] = [dot(axis, right) * .15, dot(axis, down) * .15];
    svg("line", { x1: x, y1: y, x2: x + dx, y2: y + dy, class: attributes.class });
    return svg("circle", { cx: x, cy: y, r: .05, ...attributes });
  };
  byId("rig").replaceChildren();
  scene.cameras.forEach((each, number) => {
    const circle = mark(each, { class: nearest.some((near) => near.number === number) ? "near" : "" });
    circle.addEventListener("click", () => snap(number));
    circle.appendChild(document.createElementNS("http://www.w3.org/2000/svg", "title")).textContent = each.name;
  });
  const [x, y] = flat(scene.target);
  svg("path", { d: `M${x - .05} ${y}h.1M${x} ${y - .05}v.1`, stroke: "currentColor", "stroke-width": .015 });
  mark(camera, { class: "here" });
}
function drawPanel() {
  const nearest = nearestNumbers();
  drawNearest(nearest);
  drawRig(nearest);
}
function drawKeys() {
  byId("keys").replaceChildren(...keys.map((key, i) => {
    const item = document.createElement("li");
    const button = (text, act) => {
      const made = Object.assign(document.createElement("button"), { textContent: text });
      made.addEventListener("click", act);
      return made;
    };
    item.append(button("Go to", () => go(key)), button("Delete", () => { keys.splice(i, 1); drawKeys(); }));
    return item;
  }));
  byId("path").disabled = keys.length < 2;
}
function addKey() {
  keys.push(structuredClone(camera));
  drawKeys();
}

// ---- files -------------------------------------------------------------------------------------
function download(url, name) {
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
}
const downloadText = (text, name) => download(URL.createObjectURL(new Blob([text])), name);
const cameraFile = () => "1\nview.png " + [...camera.K, ...camera.R, ...camera.T].join(" ") + "\n";
const pathFile = () => JSON.stringify({ size: camera.width + "x" + camera.height,
  keys: keys.map(({ K, R, T }) => ({ K, R, t: T })) }, null, 1);

// ---- input -------------------------------------------------------------------------------------
const pointers = new Map(); // what is pressed, and where it was last
function movePointers(event) {
  const last = pointers.get(event.pointerId);
  if (!last) return;
  const now = [event.clientX, event.clientY];
  const [dx, dy] = [now[0] - last[0], now[1] - last[1]];
  pointers.set(event.pointerId, now);
  if (pointers.size === 1) {
    (event.buttons & 2 ? pan : drag)(dx, dy);
  } else if (pointers.size === 2) {
    const other = [...pointers.entries()].find(([id]) => id !== event.pointerId)[1];
    zoom(Math.hypot(last[0] - other[0], last[1] - other[1]) / Math.max(1, Math.hypot(now[0] - other[0], now[1] - other[1])));
    pan(dx / 2, dy / 2);
  }
}
function pressKey(event) {
  const step = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, -10], ArrowDown: [0, 10] }[event.key];
  if (step) (event.shiftKey ? pan : drag)(...step);
  else if (event.key === "+") zoom(.9);
  else if (event.key === "-") zoom(1 / .9);
  else if (event.key === "n") snap(byId("cameras").selectedIndex + 1);
  else if (event.key === "p") snap(byId("cameras").selectedIndex - 1);
  else if (event.key === "k") addKey();
  else return;
  event.preventDefault();
}
function listen() {
  picture.addEventListener("pointerdown", (event) => {
    picture.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    picture.focus();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    picture.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  picture.addEventListener("pointermove", movePointers);
  picture.addEventListener("dragstart", (event) => event.preventDefault());
  picture.addEventListener("contextmenu", (event) => event.preventDefault());
  picture.addEventListener("dblclick", pick);
  picture.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(event.deltaY * .001)); },
    { passive: false });
  picture.addEventListener("keydown", pressKey);
  byId("cameras").addEventListener("change", () => snap(byId("cameras").selectedIndex));
  byId("stage").addEventListener("change", moved);
  byId("show").addEventListener("change", moved);
  byId("add").addEventListener("click", addKey);
  byId("pivot").addEventListener("click", () => { scene.target = scene.middle; drawPanel(); });
  byId("path").addEventListener("click", () => downloadText(pathFile(), "cameras.json"));
  byId("save").addEventListener("click", () => { if (shown) download(picture.src, "novel.png"); });
  byId("camera").addEventListener("click", () => downloadText(cameraFile(), "view_par.txt"));
  byId("spec").addEventListener("click", () => navigator.clipboard.writeText("file:view_par.txt#view.png")
    .then(() => tell("copied; save the camera, too")).catch(() => tell("file:view_par.txt#view.png")));
}
async function begin() {
  const answer = await fetch("/state", { headers: { "X-Token": token } });
  const state = await answer.json();
  if (!state.cameras) {
    tell((state.stage || "starting") + " " + Math.round(100 * (state.fraction || 0)) + " %");
    setTimeout(begin, 200);
    return;
  }
  scene = state;
  scene.middle = scene.target;
  scene.cameras.forEach((each) => byId("cameras").add(new Option(each.name)));
  listen();
  snap(0);
}
begin();
