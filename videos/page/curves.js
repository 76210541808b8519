// The curves of one chart: a canvas, drawn anew when there is more to see.
const curveColors = ["#e69f00", "#56b4e9", "#29b58c", "#f0e442", "#d98cb8"];
function drawChart(canvas, panels, share, times) {
  const scale = devicePixelRatio || 1;
  const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const pen = canvas.getContext("2d");
  pen.scale(scale, scale);
  const [left, right] = [2.9 * rem, width - 0.9 * rem];
  pen.font = `${0.74 * rem}px ${getComputedStyle(canvas).fontFamily}`;
  const room = (height - 1.1 * rem) / panels.length;
  pen.fillStyle = "#a9b3c2";
  times.forEach((time, i) => {
    const part = i / (times.length - 1);
    pen.textAlign = part === 0 ? "left" : part === 1 ? "right" : "center";
    pen.fillText(i === 0 ? `t = ${time}` : time, left + part * (right - left), height - 0.45 * rem);
  });
  panels.forEach((panel, row) => {
    const [head, foot] = [row * room + 1.55 * rem, (row + 1) * room - 0.45 * rem];
    let [low, high] = [panel.low, panel.high];
    for (const curve of panel.curves) {
      for (const value of curve.values) {
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (panel.most && high > panel.most / 2) high = panel.most;
    const log = low > 0 && high > 30;
    if (log) high = Math.min(high, 1e12);
    const place = (value) => foot - (foot - head) * Math.min(1, log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
    pen.textAlign = "right";
    for (const value of [low, high]) {
      pen.strokeStyle = "#3a4452";
      pen.beginPath();
      pen.moveTo(left, Math.round(place(value)) + 0.5);
      pen.lineTo(right, Math.round(place(value)) + 0.5);
      pen.stroke();
      pen.fillStyle = "#a9b3c2";
      const digits = Math.abs(value) >= 1e4 ? value.toExponential(0) : String(Math.abs(value) < 1e-6 * high ? 0 : Number(value.toPrecision(3)));
      pen.fillText(digits + (panel.unit === "°" ? "°" : ""), left - 0.35 * rem, place(value) + 0.25 * rem);
    }
    pen.textAlign = "left";
    let x = left;
    panel.curves.forEach((curve, i) => {
      pen.strokeStyle = pen.fillStyle = curveColors[i % curveColors.length];
      pen.lineWidth = 2;
      pen.setLineDash(i % 5 === 1 ? [7, 3] : i % 5 === 2 ? [3, 2] : []);
      pen.lineJoin = "round";
      pen.beginPath();
      let open = false;
      for (let n = 0; n < curve.values.length; ++n) {
        const value = curve.values[n];
        if (!Number.isFinite(value)) { open = false; continue; }
        const at = left + (right - left) * Math.min(1, n * share);
        if (open) pen.lineTo(at, place(value)); else pen.moveTo(at, place(value));
        open = true;
      }
      pen.stroke();
      pen.beginPath();
      pen.moveTo(x, head - 0.75 * rem);
      pen.lineTo(x + 1.3 * rem, head - 0.75 * rem);
      pen.stroke();
      pen.setLineDash([]);
      pen.lineWidth = 1;
      pen.fillStyle = "#d6dce5";
      pen.fillText(curve.label, x + 1.7 * rem, head - 0.5 * rem);
      x += 2.8 * rem + pen.measureText(curve.label).width;
    });
    for (const mark of panel.marks) {
      const at = left + (right - left) * mark.frame * share;
      pen.strokeStyle = "#f0e442";
      pen.setLineDash([4, 3]);
      pen.beginPath();
      pen.moveTo(at, head);
      pen.lineTo(at, foot);
      pen.stroke();
      pen.setLineDash([]);
      if (row > 0) continue;
      const long = pen.measureText(mark.label).width;
      const free = [at + 5, at - 5 - long].find((x) => x >= left && x + long <= right);  // beside the mark, where there is room
      pen.fillStyle = "#f0e442";
      pen.fillText(mark.label, free ?? Math.max(left, right - long), head + 0.75 * rem);
    }
  });
}
