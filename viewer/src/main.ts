// Finds the document (in the page itself, or on the server that the page came from) and shows it,
// or says in one sentence why it cannot.

import "./style.css";
import { decodeDocument } from "./data/decode.js";
import { Malformed } from "./data/reader.js";
import type { Page } from "./api.js";
import { publish } from "./api.js";
import { showDocument } from "./app.js";
import { servedDocument } from "./live/served.js";
import { byId, element } from "./panels/dom.js";
import { applyTheme, preferredTheme } from "./theme.js";

const nothingToShow =
  "This page shows what Foretouch found, but nothing has been put into it. Make one with: foretouch replay CLIP --scene SCENE --report report.html";

let page: Page | null = null;
let error: string | null = null;

async function documentText(): Promise<string> {
  const own = document.getElementById("foretouch-view")?.textContent?.trim() ?? "";
  if (own !== "") return own;
  if (!location.protocol.startsWith("http")) throw new Malformed(nothingToShow, "");
  return servedDocument();
}

function refuse(reason: unknown): void {
  const isKnown = reason instanceof Malformed;
  error = isKnown ? reason.message : `This page failed to show the document (${String(reason)}).`;
  document.body.classList.add("refused");
  byId("headline").textContent = "There is nothing to show.";
  byId("panels").replaceChildren();
  byId("controls").replaceChildren();
  byId("view").replaceChildren(element("p", { class: "refusal", text: error }));
}

async function start(): Promise<void> {
  applyTheme(preferredTheme());
  try {
    page = showDocument(decodeDocument(await documentText()));
  } catch (reason) {
    page = null;
    refuse(reason);
  }
}

publish(start(), () => page, () => error);
