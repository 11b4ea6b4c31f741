/* global CanvasRenderingContext2D, HTMLCanvasElement, document */
// What a page draws on its canvases, by the interface of the browser: tests load this before the page.
// A canvas that is drawn on another one brings along what it shows.
globalThis.drawn = (() => {
  const proto = CanvasRenderingContext2D.prototype;
  const shown = new WeakMap(); // what a canvas shows since it was last cleared
  const paths = new WeakMap(); // arcs, lines and fields of the path that a context is drawing
  const counts = new Map(); // how often each method was called on each canvas, by its name
  const on = (canvas) => shown.get(canvas) ?? (shown.set(canvas, []), shown.get(canvas));

  const watch = (name, note) => {
    const draw = proto[name];
    proto[name] = function (...args) {
      if (!counts.has(this.canvas)) counts.set(this.canvas, {});
      const found = counts.get(this.canvas);
      found[name] = (found[name] ?? 0) + 1;
      note?.call(this, ...args);
      return draw.apply(this, args);
    };
  };
  const transform = (context, x, y) => {
    const { a, b, c, d, e, f } = context.getTransform();
    return [a * x + c * y + e, b * x + d * y + f];
  };
  const scaleOf = (context) => {
    const { a, b } = context.getTransform();
    return Math.hypot(a, b);
  };
  const notePath = (isFilled) =>
    function (path) {
      if (typeof path === "object") return;
      const colour = isFilled ? this.fillStyle : this.strokeStyle;
      const isDashed = !isFilled && this.getLineDash().length > 0;
      const { arcs, lines, fields } = paths.get(this) ?? emptyPath();
      const seen = on(this.canvas);
      for (const arc of arcs) seen.push({ ...arc, colour, isFilled, isDashed });
      for (const corners of fields) seen.push({ field: corners, colour, isFilled });
      if (isFilled) return;
      const width = this.lineWidth * scaleOf(this);
      for (const line of lines)
        if (line.length > 1) seen.push({ line, colour, width, opacity: this.globalAlpha });
    };
  const emptyPath = () => ({ arcs: [], lines: [], fields: [] });

  watch("clearRect", function (x, y, width, height) {
    if (width >= this.canvas.width && height >= this.canvas.height) shown.set(this.canvas, []);
  });
  watch("beginPath", function () {
    paths.set(this, emptyPath());
  });
  watch("arc", function (x, y, radius) {
    const [[left, top], [right, bottom]] = [transform(this, x, y), transform(this, x + radius, y)];
    const arc = { at: [left, top], radius: Math.hypot(right - left, bottom - top) };
    paths.get(this)?.arcs.push(arc);
  });
  watch("moveTo", function (x, y) {
    paths.get(this)?.lines.push([transform(this, x, y)]);
  });
  watch("lineTo", function (x, y) {
    const lines = paths.get(this)?.lines;
    if (lines && !lines.length) lines.push([]); // as if it were moved to
    lines?.at(-1).push(transform(this, x, y));
  });
  watch("roundRect", function (x, y, width, height) {
    const corners = [transform(this, x, y), transform(this, x + width, y + height)];
    paths.get(this)?.fields.push(corners);
  });
  watch("fill", notePath(true));
  watch("stroke", notePath(false));
  watch("fillText", function (text, x, y) {
    const ink = this.measureText(text);
    const [left, right] = [x - ink.actualBoundingBoxLeft, x + ink.actualBoundingBoxRight];
    const [top, bottom] = [y - ink.actualBoundingBoxAscent, y + ink.actualBoundingBoxDescent];
    const corners = [left, right].flatMap((u) => [top, bottom].map((v) => transform(this, u, v)));
    on(this.canvas).push({ text, corners, at: transform(this, x, y), moves: true });
  });
  watch("drawImage", function (source, x, y, width, height) {
    const corners = [
      [x, y],
      [x + width, y],
      [x, y + height],
    ].map((corner) => transform(this, ...corner));
    const below = source instanceof HTMLCanvasElement ? on(source) : [{ picture: corners }];
    on(this.canvas).push(...below.map((each) => ({ ...each, moves: false })));
  });
  watch("fillRect");

  const ratioOf = (canvas) => canvas.width / canvas.clientWidth;
  const find = (canvas) => (typeof canvas === "string" ? document.getElementById(canvas) : canvas);
  return {
    texts(id) {
      const canvas = find(id);
      const ratio = ratioOf(canvas);
      return on(canvas)
        .filter(({ corners }) => corners)
        .map(({ text, corners, at, moves }) => {
          const [xs, ys] = [0, 1].map((axis) => corners.map((corner) => corner[axis] / ratio));
          const box = [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
          return { text, box, at: at.map((pixels) => pixels / ratio), moves };
        });
    },
    discs(id) {
      const canvas = find(id);
      const ratio = ratioOf(canvas);
      return on(canvas)
        .filter(({ radius }) => radius !== undefined)
        .map(({ at: [x, y], radius, colour, isFilled, isDashed }) => ({
          x: x / ratio,
          y: y / ratio,
          radius: radius / ratio,
          colour,
          is_filled: isFilled,
          is_dashed: isDashed,
        }));
    },
    lines(id) {
      const canvas = find(id);
      const ratio = ratioOf(canvas);
      return on(canvas)
        .filter(({ line }) => line)
        .map(({ line, colour, width, opacity }) => ({
          points: line.map((point) => point.map((pixels) => pixels / ratio)),
          colour,
          width: width / ratio,
          opacity,
        }));
    },
    fields(id) {
      const canvas = find(id);
      const ratio = ratioOf(canvas);
      return on(canvas)
        .filter(({ field }) => field)
        .map(({ field, colour, isFilled }) => ({
          box: field.flat().map((pixels) => pixels / ratio),
          colour,
          is_filled: isFilled,
        }));
    },
    pictures(id) {
      const canvas = find(id);
      const ratio = ratioOf(canvas);
      return on(canvas)
        .filter(({ picture }) => picture)
        .map(({ picture }) => picture.map((corner) => corner.map((pixels) => pixels / ratio)));
    },
    colour(id, x, y) {
      const canvas = find(id);
      const [column, row] = [x, y].map((pixels) => Math.round(pixels * ratioOf(canvas)));
      return Array.from(canvas.getContext("2d").getImageData(column, row, 1, 1).data);
    },
    calls(id) {
      const sum = {};
      for (const [canvas, calls] of counts)
        if (id === null || canvas === find(id))
          for (const [name, times] of Object.entries(calls)) sum[name] = (sum[name] ?? 0) + times;
      return sum;
    },
  };
})();
