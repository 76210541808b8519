// Ties each film to its chart, which is its only scrubber, and to its player. Everything else on the page does without.
"use strict";

const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
const start = (video) => video.play().catch(() => {});  // a pause may come before the film
const status = document.getElementById("status");
const speeds = { 1: "1×", 0.5: "½×", 0.25: "¼×", 0.1: "⅒×" };

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
  if (!video) return;
  const screen = film.querySelector(".screen");
  const seek = film.querySelector(".seek");
  const cursor = film.querySelector(".cursor");
  const player = film.querySelector(".player");
  const button = Object.fromEntries([...player.querySelectorAll("button")].map((b) => [b.dataset.do, b]));
  const [seconds, from, span, fps] = ["seconds", "from", "span", "fps"].map((key) => Number(screen.dataset[key]));
  const panels = [...film.querySelectorAll(".panel")].map((panel) => ({
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
    const t = (from + share * span).toFixed(span < 100 ? 1 : 0);
    cursor.style.left = share * 100 + "%";
    player.querySelector(".clock").textContent = "t = " + t;
    const words = ["t = " + t];
    for (const panel of panels) {
      panel.keys.forEach((key, i) => {
        const value = key.querySelector(".value");
        value.textContent = shown(valueAt(panel.curves[i] || [], panel, share), panel.unit);
        words.push(key.textContent.trim());
      });
    }
    if (!video.paused) return;  // who listens is told where the film stands, not every frame
    seek.setAttribute("aria-valuenow", (share * span).toFixed(2));
    seek.setAttribute("aria-valuetext", words.join(", "));
  };
  const now = () => (wanted === null ? video.currentTime : wanted);
  const go = (time) => {
    time = Math.min(Math.max(time, 0), Math.max(seconds - 0.5 / fps, 0));
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
  const step = (frames) => {
    video.pause();
    go((Math.floor(now() * fps + 0.01) + frames + 0.5) / fps);  // to the middle of a frame
  };
  const actions = {
    play: () => (video.paused ? start(video) : video.pause()),
    back: () => step(-1),
    on: () => step(1),
    speed: () => {
      const rates = Object.keys(speeds).map(Number).sort((a, b) => b - a);
      video.defaultPlaybackRate = video.playbackRate = rates[(rates.indexOf(video.playbackRate) + 1) % rates.length];
      button.speed.textContent = speeds[video.playbackRate];
      button.speed.setAttribute("aria-label", "Speed: " + speeds[video.playbackRate]);
    },
    captions: () => {
      const track = video.textTracks[0];
      track.mode = track.mode === "showing" ? "disabled" : "showing";
      button.captions.setAttribute("aria-pressed", track.mode === "showing");
    },
    full: () => {
      if (document.fullscreenElement) document.exitFullscreen();
      else if (screen.requestFullscreen) screen.requestFullscreen();
      else video.webkitEnterFullscreen?.();  // a phone that knows only films
    },
  };
  const letters = { " ": "play", ",": "back", ".": "on", s: "speed", c: "captions", f: "full" };
  const moves = { ArrowLeft: -0.1, ArrowDown: -0.1, ArrowRight: 0.1, ArrowUp: 0.1, PageDown: -1, PageUp: 1, Home: -seconds, End: seconds };

  const follow = () => {
    draw(now());
    if (!video.paused && !video.ended) requestAnimationFrame(follow);
  };
  const tell = () => {
    screen.classList.toggle("playing", !video.paused);
    screen.classList.add("begun");
    button.play.setAttribute("aria-label", video.paused ? "Play" : "Pause");
    button.play.querySelector("use").setAttribute("href", video.paused ? "#i-play" : "#i-pause");
  };
  video.addEventListener("loadedmetadata", () => {
    if (wanted !== null) video.currentTime = wanted;
    wanted = null;
  });
  video.addEventListener("play", () => {
    for (const other of document.querySelectorAll("video")) if (other !== video) other.pause();
    tell();
    follow();
  });
  video.addEventListener("pause", tell);
  for (const event of ["seeking", "seeked", "timeupdate", "pause"]) video.addEventListener(event, () => draw(now()));
  video.addEventListener("click", actions.play);
  video.controls = false;

  const timeOf = (event) => {
    const box = seek.getBoundingClientRect();
    return ((event.clientX - box.left) / box.width) * seconds;
  };
  seek.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    seek.setPointerCapture(event.pointerId);
    go(timeOf(event));
  });
  seek.addEventListener("pointermove", (event) => {
    if (seek.hasPointerCapture(event.pointerId)) go(timeOf(event));
  });
  seek.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key in moves) go(now() + moves[event.key]);
    else if (event.key.toLowerCase() in letters) actions[letters[event.key.toLowerCase()]]();
    else return;
    event.preventDefault();
  });
  // One stop for the tab key; arrows go from button to button.
  player.addEventListener("click", (event) => actions[event.target.closest("button")?.dataset.do]?.());
  player.addEventListener("keydown", (event) => {
    const all = Object.values(button);
    const next = all[all.indexOf(document.activeElement) + { ArrowLeft: -1, ArrowRight: 1 }[event.key]];
    if (!next) return;
    for (const one of all) one.tabIndex = one === next ? 0 : -1;
    next.focus();
    event.preventDefault();
  });
  for (const link of film.querySelectorAll("[data-time]")) {
    link.addEventListener("click", (event) => {
      event.preventDefault();
      video.pause();
      go(Number(link.dataset.time));
      screen.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
    });
  }
  for (const part of [seek, player, film.querySelector(".start")]) part.removeAttribute("hidden");
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
    snippet.textContent = snippet.relative.replace(/\b(src|poster|href)="/g, (found) => found + safe);
  }
  for (const input of document.querySelectorAll(".base")) if (input.value !== folder) input.value = folder;
}

document.querySelectorAll(".film").forEach(connect);
for (const button of document.querySelectorAll("[data-copy]")) {
  button.hidden = false;
  button.addEventListener("click", () => copy(button));
}
for (const input of document.querySelectorAll(".base")) input.addEventListener("input", () => nameFolder(input.value.trim()));
// Where a page opened from a disk is, nobody else finds anything.
nameFolder(location.protocol === "file:" ? "" : new URL(".", location.href).href);

// The first screen's book turns by itself, until its button is pressed or another film runs.
const hero = document.querySelector(".hero video");
if (hero) {
  const hold = document.querySelector(".hold");
  const begin = Number(hero.dataset.begin);
  hero.currentTime = begin;
  hero.addEventListener("ended", () => { hero.currentTime = begin; start(hero); });
  for (const event of ["play", "pause"]) hero.addEventListener(event, () => { hold.textContent = hero.paused ? "Play" : "Pause"; });
  hold.addEventListener("click", () => (hero.paused ? start(hero) : hero.pause()));
  hold.hidden = false;
  if (!calm) start(hero);
}

// A film that nobody sees need not run.
const watch = new IntersectionObserver((entries) => {
  for (const entry of entries) if (!entry.isIntersecting && !entry.target.paused) entry.target.pause();
});
document.querySelectorAll("video").forEach((video) => watch.observe(video));
