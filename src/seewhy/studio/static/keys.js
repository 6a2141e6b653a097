// Label by keyboard: a key presses the button or link that names it. Keys that come while an
// answer is on its way wait for it, in their order, so that nobody has to.
"use strict";

(() => {
  const waiting = [];
  let busy = false;

  const typing = (element) =>
    element.matches("textarea, select, [contenteditable]") ||
    (element.matches("input") && !["checkbox", "radio", "button", "submit"].includes(element.type));

  function keyOf(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return null;
    return event.key === "Delete" && !target("Delete") ? "Backspace" : event.key;
  }

  const target = (key) => document.querySelector(`[data-key="${CSS.escape(key)}"]:not(:disabled)`);

  function press(key) {
    const found = target(key);
    if (!found) return false;
    found.click();
    return true;
  }

  document.addEventListener("keydown", (event) => {
    const key = keyOf(event);
    if (key === null || key === "Tab" || typing(event.target)) return;
    // Enter and space press what has the focus, where somebody has gone there with Tab.
    if (key === "Enter" && event.target.matches("a, button, summary")) return;
    if (busy) {
      if (!event.repeat) waiting.push(key);
      event.preventDefault();
      return;
    }
    if (press(key)) event.preventDefault();
  });

  // What answers a key: not the news, which come by themselves.
  const matters = (event) => !event.detail.pathInfo?.requestPath?.startsWith("/label/news");

  document.addEventListener("htmx:beforeRequest", (event) => {
    if (!matters(event)) {
      // News that would come in between are left out; the answer brings them.
      if (busy) event.preventDefault();
      return;
    }
    busy = true;
  });

  // Nor are they shown while somebody presses a button or looks through a list.
  let held = false;
  document.addEventListener("pointerdown", () => { held = true; });
  for (const kind of ["pointerup", "pointercancel"]) {
    document.addEventListener(kind, () => setTimeout(() => { held = false; }));
  }
  document.addEventListener("htmx:beforeSwap", (event) => {
    if (matters(event) || !event.detail.shouldSwap) return;
    const choosing = document.activeElement?.matches("select, input:not([type=hidden])");
    if (busy || held || choosing) event.detail.shouldSwap = false;
    // Until news have settled their forms are not htmx's yet: a key waits, or the page would be left.
    else busy = true;
  });

  function release() {
    busy = false;
    while (waiting.length && !busy) {
      const next = waiting.shift();
      if (typeof next === "string") press(next);
      else next();
    }
  }

  // What another script asks for waits in the same row.
  document.addEventListener("label:do", (event) => {
    if (busy) waiting.push(event.detail);
    else event.detail();
  });

  // Only when an answer, or news, have settled do its buttons and links ask in their turn.
  document.addEventListener("htmx:afterSettle", release);
  document.addEventListener("htmx:afterRequest", (event) => {
    if (matters(event) && (event.detail.failed || event.detail.xhr.status === 204)) release();
  });

  // A value that has no button of its own is said by choosing it.
  document.addEventListener("change", (event) => {
    if (event.target.matches("[data-submits]") && event.target.value) event.target.form.requestSubmit();
  });

  // What had the focus has it again after an exchange, so that Tab goes on from there.
  let focused = null;
  document.addEventListener("htmx:beforeSwap", () => {
    const element = document.activeElement;
    focused = element && element.closest("#workbench") ? [element.name, element.value, element.dataset.key] : null;
  });
  document.addEventListener("htmx:afterSettle", () => {
    if (!focused) return;
    const [name, value, key] = focused;
    const again =
      (name && document.querySelector(`#workbench [name="${CSS.escape(name)}"][value="${CSS.escape(value || "")}"]`)) ||
      (key && document.querySelector(`#workbench [data-key="${CSS.escape(key)}"]`));
    if (again && !again.matches("[type=hidden]")) again.focus();
  });
})();
