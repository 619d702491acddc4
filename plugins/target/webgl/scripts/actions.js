import { element } from "../../../../sdk/web/elements.js";
import { fragmentOf } from "./link.js";
import { announce, showError, showNotice } from "./messages.js";
import { commandLineOf, queryOf } from "./options.js";

async function copyToClipboard(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}

const SHOWN_MS = 2500;

/** Shows the outcome on a button for a while. */
function showOn(button, text) {
    button.dataset.name ??= button.textContent;
    button.textContent = text;
    clearTimeout(button.timer);
    button.timer = setTimeout(() => { button.textContent = button.dataset.name; }, SHOWN_MS);
}

/** Rows of RGBA bytes as a PNG file in a data: URL. */
export function pngUrl(pixels, width, height) {
    const canvas = element("canvas", { width, height });
    canvas.getContext("2d").putImageData(new ImageData(pixels, width, height), 0, 0);
    return canvas.toDataURL("image/png");
}

/** Connects the buttons below the picture. `render`: gets a width and a height, resolves to rows of RGBA bytes. */
export function connectActions(settings, render) {
    const onClick = (id, action) => document.getElementById(id).addEventListener("click", action);
    onClick("reset-view", () => {
        settings.resetView();
        announce("The view is reset.");
    });
    onClick("reset-all", () => {
        settings.reset();
        showNotice("");
        history.replaceState(null, "", location.pathname + location.search);
        announce("All settings are reset to the scene's.");
    });
    onClick("copy-link", async () => {
        history.replaceState(null, "", fragmentOf(settings) || location.pathname + location.search);
        const isCopied = await copyToClipboard(location.href);
        announce(isCopied ? "The link was copied." : "The link is in the address bar.");
        showOn(document.getElementById("copy-link"), isCopied ? "Link copied" : "Link in the address bar");
    });
    onClick("copy-options", async () => {
        const button = document.getElementById("copy-options"), text = commandLineOf(settings);
        if (text === "") {
            showOn(button, "No changes to copy");
            return;
        }
        const isCopied = await copyToClipboard(text);
        announce(isCopied ? "The options for candela render were copied." : text);
        if (isCopied) showOn(button, "Options copied");
        else showNotice(text);
    });
    onClick("save-picture", async () => {
        const { width, height } = settings.scene.image;
        try {
            const href = pngUrl(await render(width, height), width, height);
            element("a", { href, download: `${settings.scene.title}.png` }).click();
            announce("The picture was saved.");
        } catch (error) {
            showError(error);
        }
    });
}

/** If `candela view` serves the page, changes made in it can be written to the scene's files. */
export function connectSaving(settings) {
    const button = document.getElementById("save-scene");
    button.hidden = false;
    button.addEventListener("click", async () => {
        const query = queryOf(settings);
        if (query === "") {
            showOn(button, "No changes to save");
            return;
        }
        button.disabled = true;
        settings.expectSaved(new Map(settings.changes));
        let problem = "";
        try {
            const response = await fetch(`save?${query}`, { method: "POST" });
            if (response.ok) announce("The changes were saved.");
            else problem = (await response.text()).trim();
        } catch (error) {
            problem = error.message;
        }
        button.disabled = false;
        if (problem !== "") settings.expectSaved(new Map());
        showNotice(problem === "" ? "" : `The changes were not saved. ${problem}`);
        showOn(button, problem === "" ? "Saved" : "Not saved");
    });
}
