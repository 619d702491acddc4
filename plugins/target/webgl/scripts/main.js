import { element } from "../../../../sdk/web/elements.js";
import { showError } from "./messages.js";
import { Page } from "./page.js";

const page = new Page();
const ready = (async () => page.start())();

/** For scripts: `ready` resolves when the page works, or rejects with the reason; `render` resolves to rows of RGBA bytes. */
window.candela = {
    ready,
    render: async (width, height) => {
        await ready;
        return page.pixels(width, height);
    },
};

ready.catch((error) => {
    document.body.classList.add("failed");
    // The page's own heading is next to the picture, which is not shown.
    document.querySelector("main").prepend(element("h1", { dir: "auto" }, document.title));
    showError(error);
    // Read by `candela verify`.
    const text = [error.message, error.detail].filter(Boolean).join("\n");
    document.body.append(element("pre", { id: "problem", hidden: true }, text));
});
