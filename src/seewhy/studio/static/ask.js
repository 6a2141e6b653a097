// Ask: what a reason, or a row, speaks of is marked in the picture; and questions by voice.
"use strict";

(() => {
  // The boxes of what is pointed at, or else of what has the focus.
  const mark = (pointed) => {
    const said = pointed || document.activeElement?.closest("[data-of]") || document.activeElement?.querySelector(":scope > [data-of]");
    const numbers = said ? said.dataset.of.split(" ") : [];
    for (const box of document.querySelectorAll(".boxes.read .box")) {
      box.classList.toggle("pointed", numbers.includes(box.dataset.number));
    }
  };
  const pointed = (event) => event.target.closest?.("[data-of]");
  document.addEventListener("pointerover", (event) => mark(pointed(event)));
  document.addEventListener("focusin", () => mark(null));
  document.addEventListener("focusout", () => mark(null));

  // What was chosen in the picture may be shown further down.
  document.addEventListener("htmx:afterSettle", (event) => {
    if (!event.detail.requestConfig?.elt.matches("[data-goes]")) return;
    document.getElementById("supposed-form")?.scrollIntoView({ block: "nearest" });
  });
})();

// By voice, where the browser can: what is heard is written into the question and asked.
(() => {
  const Recognition = window.SpeechRecognition || window.webkitSpeechRecognition;
  if (!Recognition) return;

  const reveal = () => {
    for (const button of document.querySelectorAll("[data-speak]")) button.hidden = false;
  };

  document.addEventListener("click", (event) => {
    const button = event.target.closest("[data-speak]");
    if (!button) return;
    const form = button.closest("form");
    const heard = new Recognition();
    heard.lang = "en";
    heard.onstart = () => button.setAttribute("aria-pressed", "true");
    heard.onend = () => button.setAttribute("aria-pressed", "false");
    heard.onresult = (result) => {
      form.elements.question.value = result.results[0][0].transcript;
      form.requestSubmit(form.querySelector("button:not([type])"));
    };
    heard.start();
  });

  reveal();
  document.addEventListener("htmx:afterSettle", reveal);
})();
