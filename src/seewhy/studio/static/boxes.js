// Boxes over the picture: drawn, moved and resized by mouse, by touch and by keys. All numbers are
// pixels of the picture itself; how large it is shown matters only to what the hand can meet.
"use strict";

(() => {
  const SLIP = 4; // pixels of the screen: who moves less has clicked
  const REACH = { mouse: 10, pen: 16, touch: 24 }; // from a corner, in pixels of the screen
  const PAUSE = 350; // milliseconds after the last arrow, until what was moved is kept
  const LETTER = 14; // pixels of the screen

  const sheet = () => document.getElementById("boxes");
  const groups = () => [...document.querySelectorAll("#boxes .box")];
  const groupOf = (thing) => groups().find((group) => group.dataset.thing === thing);
  const boxOf = (group) => group.dataset.box.split(" ").map(Number);
  const within = ([x, y], [left, top, right, bottom]) => left <= x && x <= right && top <= y && y <= bottom;
  const area = ([left, top, right, bottom]) => (right - left) * (bottom - top);

  function pointOf(event) {
    const there = new DOMPoint(event.clientX, event.clientY).matrixTransform(sheet().getScreenCTM().inverse());
    const { width, height } = sheet().dataset;
    return [Math.min(Math.max(there.x, 0), Number(width)), Math.min(Math.max(there.y, 0), Number(height))];
  }

  const onScreen = () => sheet().getScreenCTM().a; // pixels of the screen for one of the picture

  // Exchanges ------------------------------------------------------------------------------------

  // What asks waits until the answer before it has settled, as keys do.
  const later = (act) => document.dispatchEvent(new CustomEvent("label:do", { detail: act }));

  function keep(thing, box) {
    const [left, top, right, bottom] = box.map(Math.round);
    const picture = sheet().dataset.picture;
    later(() => htmx.ajax("POST", "/label/thing/draw", {
      source: sheet(), target: "#workbench", swap: "outerHTML",
      values: { picture, thing, left, top, right, bottom },
    }));
  }

  function choose(thing) {
    const picture = sheet().dataset.picture;
    later(() => htmx.ajax("GET", "/label", {
      source: sheet(), target: "#workbench", swap: "outerHTML", values: thing ? { picture, thing } : { picture },
    }));
  }

  // Showing --------------------------------------------------------------------------------------

  function show(group, [left, top, right, bottom]) {
    for (const rect of group.querySelectorAll("rect")) {
      rect.setAttribute("x", left);
      rect.setAttribute("y", top);
      rect.setAttribute("width", right - left);
      rect.setAttribute("height", bottom - top);
    }
    group.querySelector("text")?.setAttribute("x", left);
    group.querySelector("text")?.setAttribute("y", top);
    const corners = [[left, top], [right, top], [left, bottom], [right, bottom]];
    group.querySelectorAll(".corner").forEach((corner, place) =>
      corner.setAttribute("d", `M ${corners[place][0]} ${corners[place][1]} h 0`));
  }

  function showNew(box) {
    let group = document.getElementById("drawn-now");
    if (!group) {
      const made = (name) => document.createElementNS("http://www.w3.org/2000/svg", name);
      group = made("g");
      group.id = "drawn-now";
      for (const kind of ["halo", "line"]) group.appendChild(made("rect")).setAttribute("class", kind);
      sheet().append(group);
    }
    show(group, box);
  }

  function scaleLetters() {
    sheet()?.setAttribute("font-size", LETTER / onScreen());
  }

  // By mouse and by touch ------------------------------------------------------------------------

  let drag = null;

  function atCorner([x, y], [left, top, right, bottom], reach) {
    const near = (one, other) => Math.abs(one - other) <= reach;
    const across = near(x, left) ? right : near(x, right) ? left : null;
    const down = near(y, top) ? bottom : near(y, bottom) ? top : null;
    return across !== null && down !== null ? [across, down] : null; // the corner that stays
  }

  document.addEventListener("pointerdown", (event) => {
    if (!event.target.closest?.("#boxes") || event.button !== 0 || !event.isPrimary) return;
    event.preventDefault();
    keepPending();
    const from = pointOf(event);
    const thing = sheet().dataset.chosen || "";
    const box = groupOf(thing) && boxOf(groupOf(thing));
    const stays = box && atCorner(from, box, REACH[event.pointerType] / onScreen());
    drag = { thing, box, from, stays, at: [event.clientX, event.clientY], moved: false };
    if (stays) drag.does = "resize";
    else if (box && within(from, box) && !event.shiftKey) drag.does = "move";
    else drag.does = "draw";
  });

  function between([x, y], [to, down]) {
    return [Math.min(x, to), Math.min(y, down), Math.max(x, to), Math.max(y, down)];
  }

  function moved([left, top, right, bottom], across, down) {
    const { width, height } = sheet().dataset;
    const x = Math.min(Math.max(across, -left), width - right);
    const y = Math.min(Math.max(down, -top), height - bottom);
    return [left + x, top + y, right + x, bottom + y];
  }

  function dragged(event) {
    const to = pointOf(event);
    if (drag.does === "draw") return between(drag.from, to);
    if (drag.does === "resize") return between(drag.stays, to);
    return moved(drag.box, to[0] - drag.from[0], to[1] - drag.from[1]);
  }

  document.addEventListener("pointermove", (event) => {
    if (!drag || !sheet()) return;
    const far = Math.hypot(event.clientX - drag.at[0], event.clientY - drag.at[1]);
    drag.moved ||= far > SLIP;
    if (!drag.moved) return;
    const group = drag.does === "draw" ? null : groupOf(drag.thing);
    if (group) show(group, dragged(event));
    else showNew(dragged(event));
  });

  // A click chooses the smallest box there; another click the next larger one.
  function clicked(point) {
    const there = groups().filter((group) => within(point, boxOf(group)));
    there.sort((one, other) => area(boxOf(one)) - area(boxOf(other)));
    const names = there.map((group) => group.dataset.thing);
    const next = names[(names.indexOf(sheet().dataset.chosen) + 1) % names.length] || "";
    if (next !== (sheet().dataset.chosen || "")) choose(next);
  }

  document.addEventListener("pointerup", (event) => {
    if (!drag || !sheet()) return;
    const { thing, does, from } = drag;
    const box = drag.moved ? dragged(event).map(Math.round) : null;
    stopDrag();
    if (!box) {
      clicked(from);
    } else if (box[2] > box[0] && box[3] > box[1]) {
      // A thing that a table names without a box gets the one that is drawn.
      keep(does !== "draw" || (thing && !groupOf(thing)) ? thing : "", box);
    }
  });

  function stopDrag() {
    if (drag?.box && groupOf(drag.thing)) show(groupOf(drag.thing), drag.box);
    document.getElementById("drawn-now")?.remove();
    drag = null;
  }

  document.addEventListener("pointercancel", stopDrag);

  // By keys --------------------------------------------------------------------------------------

  let pending = null; // a box that arrows moved, until it is kept

  function keepPending() {
    if (!pending) return;
    clearTimeout(pending.timer);
    const { thing, box } = pending;
    pending = null;
    keep(thing, box);
  }

  function resized([left, top, right, bottom], across, down) {
    const { width, height } = sheet().dataset;
    const grown = (from, to, by, most) => Math.min(Math.max(to + by, from + 1), most);
    return [left, top, grown(left, right, across, width), grown(top, bottom, down, height)];
  }

  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

  document.addEventListener("keydown", (event) => {
    if (!sheet() || event.ctrlKey || event.metaKey || event.altKey || event.key === "Shift") return;
    if (drag && event.key === "Escape") {
      stopDrag();
      event.stopImmediatePropagation();
      return;
    }
    const arrow = ARROWS[event.key];
    const typing = event.target.matches("input:not([type=hidden]), select, textarea");
    const group = groupOf(pending?.thing || sheet().dataset.chosen);
    if (!arrow || !group || typing) {
      keepPending(); // what was moved comes before what the next key says
      return;
    }
    event.preventDefault();
    event.stopImmediatePropagation();
    const { width, height } = sheet().dataset;
    const step = Math.max(1, Math.round(Math.max(width, height) / 200)) * (event.repeat ? 3 : 1);
    const change = event.shiftKey ? resized : moved;
    const box = change(pending?.box || boxOf(group), step * arrow[0], step * arrow[1]);
    clearTimeout(pending?.timer);
    pending = { thing: group.dataset.thing, box, timer: setTimeout(keepPending, PAUSE) };
    show(group, box);
  }, true);

  window.addEventListener("pagehide", () => { pending = null; });

  // Tab leads to a box: keys speak of it from then on.
  document.addEventListener("focusin", (event) => {
    const thing = event.target.closest?.("#boxes .box")?.dataset.thing;
    if (thing !== undefined && thing !== sheet().dataset.chosen) choose(thing);
  });

  // The box that is chosen has the focus after an exchange, unless Tab has gone on meanwhile.
  let gone;
  document.addEventListener("htmx:beforeSwap", () => {
    const focused = document.activeElement?.closest("#boxes .box")?.dataset.thing;
    gone = focused === sheet()?.dataset.chosen ? undefined : focused;
  });
  document.addEventListener("htmx:afterSettle", () => {
    scaleLetters();
    const chosen = sheet()?.dataset.chosen;
    if (pending && groupOf(pending.thing)) show(groupOf(pending.thing), pending.box);
    if (chosen === undefined || ![document.body, null].includes(document.activeElement)) return;
    (groupOf(gone) || groupOf(chosen))?.focus({ preventScroll: true });
  });

  window.addEventListener("resize", scaleLetters);
  scaleLetters();
})();
