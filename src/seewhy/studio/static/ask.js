// Ask by voice, where the browser can: what is heard is written into the question and asked.
"use strict";

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
