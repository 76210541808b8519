// The live panel's keys, pressed one after the other in its picture: key, what to look at, what it then is.

export const liveKeys = [["2", "panel.book.angular_velocity[1] > 0", true], ["3", "panel.book.angular_velocity[2] > 0", true], ["1", "panel.book.angular_velocity[0] > 0", true],
  ["8", "panel.book.method", "matrix"], ["9", "panel.book.method", "quaternion"], ["0", "panel.book.method", "exact"], ["7", "panel.book.method", "springs"],
  ["n", "panel.book.normalize_every", 0], ["n", "panel.book.normalize_every", 1], ["d", "panel.book.damping", 0], ["d", "panel.book.damping", 1],
  ["+", "panel.scene.time_per_frame > 0.5", true], ["-", "panel.scene.time_per_frame <= 0.5", true], ["*", "panel.scene.substeps > 30", true],
  ["/", "panel.scene.substeps <= 30", true], ["e", "panel.withFigures", false], ["e", "panel.withFigures", true], ["g", 'panel.book.show.includes("exact")', true],
  [" ", "panel.playing", true], [" ", "panel.playing", false], ["r", "panel.place", 0], [".", "panel.place", 1], [".", "panel.place", 2], [",", "panel.place", 1],
  ["s", "panel.rate", 2], ["ArrowRight", "panel.from[0] > 0.4", true], ["v", "panel.from", [0.35, 0.3, 1]]];
