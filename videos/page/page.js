// Ties each film to the chart under it, and makes the copy buttons work. Everything else on the page does without.
"use strict";

const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
const status = document.getElementById("status");

// Points of a drawn curve: the chart is its own data.
function points(path) {
  return path.getAttribute("d").split("M").filter(Boolean).flatMap((run) =>
    run.trim().split(" ").map((pair) => pair.split(",").map(Number)));
}

// The value that a curve has at a time, in the panel's units; null where it has none.
function valueAt(curve, panel, share) {
  const x = share * 1000;
  let low = 0;
  let high = curve.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (curve[middle][0] <= x + 0.05) low = middle + 1; else high = middle;
  }
  const point = curve[Math.max(low - 1, 0)];
  if (!point || ((low === 0 || low === curve.length) && Math.abs(x - point[0]) > 10)) return null;
  const part = 1 - point[1] / 1000;
  return panel.log ? panel.low * (panel.high / panel.low) ** part : panel.low + (panel.high - panel.low) * part;
}

function shown(value, unit) {
  if (value === null) return "–";
  const size = Math.abs(value);
  const digits = size >= 100 || size === 0 ? 0 : size >= 10 ? 1 : 2;
  const number = size >= 1e5 ? value.toExponential(1) : value.toFixed(digits);
  return unit === "°" ? number + "°" : unit ? number + " " + unit : number;
}

function connect(film) {
  const video = film.querySelector("video");
  const chart = film.querySelector(".chart");
  if (!video || !chart) return;
  const seconds = Number(chart.dataset.seconds);
  const seek = chart.querySelector(".seek");
  const cursor = chart.querySelector(".cursor");
  const panels = [...chart.querySelectorAll(".panel")].map((panel) => ({
    low: Number(panel.dataset.low),
    high: Number(panel.dataset.high),
    log: panel.dataset.log === "true",
    unit: panel.dataset.unit,
    curves: [...panel.querySelectorAll("path")].map(points),
    keys: [...panel.querySelectorAll(".key")],
  }));
  let wanted = null;  // where to go once the film is there

  const draw = (time) => {
    const share = Math.min(Math.max(time / seconds, 0), 1);
    cursor.style.left = share * 100 + "%";
    const words = [];
    for (const panel of panels) {
      panel.keys.forEach((key, i) => {
        const text = shown(valueAt(panel.curves[i] || [], panel, share), panel.unit);
        key.querySelector("output").textContent = text;
        words.push(key.firstChild.nextSibling.textContent.trim() + " " + text);
      });
    }
    seek.setAttribute("aria-valuenow", time.toFixed(2));
    seek.setAttribute("aria-valuetext", time.toFixed(1) + " s: " + words.join(", "));
  };
  const now = () => (wanted === null ? video.currentTime : wanted);
  const go = (time) => {
    const last = Math.max(seconds - 0.001, 0);
    time = Math.min(Math.max(time, 0), last);
    draw(time);
    if (video.readyState >= 1) {
      video.currentTime = time;
      return;
    }
    wanted = time;
    if (video.preload === "none") {
      video.preload = "auto";
      video.load();
    }
  };

  const follow = () => {
    draw(now());
    if (!video.paused && !video.ended) requestAnimationFrame(follow);
  };
  video.addEventListener("loadedmetadata", () => {
    if (wanted !== null) video.currentTime = wanted;
    wanted = null;
  });
  video.addEventListener("play", follow);
  for (const event of ["seeking", "seeked", "timeupdate", "pause"]) video.addEventListener(event, () => draw(now()));
  if (calm) video.loop = false;

  const timeOf = (event) => {
    const box = seek.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * seconds;
  };
  seek.hidden = false;
  seek.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    seek.setPointerCapture(event.pointerId);
    go(timeOf(event));
  });
  seek.addEventListener("pointermove", (event) => {
    if (seek.hasPointerCapture(event.pointerId)) go(timeOf(event));
  });
  const steps = { ArrowLeft: -0.1, ArrowDown: -0.1, ArrowRight: 0.1, ArrowUp: 0.1, PageDown: -1, PageUp: 1 };
  seek.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key in steps) go(now() + steps[event.key]);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(seconds);
    else if (event.key === " ") video.paused ? video.play() : video.pause();
    else return;
    event.preventDefault();
  });
  for (const link of film.querySelectorAll("[data-time]")) {
    link.addEventListener("click", (event) => {
      event.preventDefault();
      go(Number(link.dataset.time));
      film.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
    });
  }
  draw(0);
}

async function copy(button) {
  const source = document.getElementById(button.dataset.copy);
  let done = false;
  try {
    await navigator.clipboard.writeText(source.textContent);
    done = true;
  } catch {
    // No clipboard for this page (plain http): select the text and copy the selection.
    const selection = getSelection();
    selection.selectAllChildren(source);
    done = document.execCommand("copy");
  }
  const label = button.textContent;
  button.textContent = done ? "Copied" : "Press Ctrl+C";
  status.textContent = done ? "Copied to the clipboard" : "Selected: press Ctrl+C";
  setTimeout(() => { button.textContent = label; }, 1500);
}

// The snippets name the folder in which the films are: where this page is now, unless the reader says otherwise.
function nameFolder(folder) {
  const base = folder && !folder.endsWith("/") ? folder + "/" : folder;
  const safe = base.replace(/&/g, "&amp;").replace(/"/g, "&quot;");
  for (const snippet of document.querySelectorAll(".snippet")) {
    snippet.relative ??= snippet.textContent;
    snippet.textContent = snippet.relative.replace(/\b(src|poster)="(?!data:)/g, (found) => found + safe);
  }
  for (const input of document.querySelectorAll(".base")) if (input.value !== folder) input.value = folder;
}

document.querySelectorAll(".film").forEach(connect);
for (const button of document.querySelectorAll(".copy")) {
  button.hidden = false;
  button.addEventListener("click", () => copy(button));
}
for (const input of document.querySelectorAll(".base")) input.addEventListener("input", () => nameFolder(input.value.trim()));
nameFolder(new URL(".", location.href).href);

// A film that nobody sees need not run.
const watch = new IntersectionObserver((entries) => {
  for (const entry of entries) if (!entry.isIntersecting && !entry.target.paused) entry.target.pause();
});
document.querySelectorAll("video").forEach((video) => watch.observe(video));
