import { decodeTextFromUrl, encodeTextForUrl } from "../../../../sdk/web/base64.js";
import { validateObserver } from "../../../../sdk/web/camera.js";
import { panesLast } from "./settings.js";
import { validateValue } from "./validation.js";

const PREFIX = "#s=";
const LINK_VERSION = 1;

/**
 * The URL fragment that restores the settings: "#s=" and the differences from the scene, as base64url of JSON; "" if nothing
 * differs.
 */
export function fragmentOf(settings) {
    if (!settings.isChanged()) return "";
    return PREFIX + encodeTextForUrl(JSON.stringify({ version: LINK_VERSION, set: Object.fromEntries(settings.changes) }));
}

/** Pairs of a path and a value; null if the fragment is broken or of another version. */
function parseFragment(fragment) {
    try {
        const state = JSON.parse(decodeTextFromUrl(fragment.slice(PREFIX.length)));
        return state.version === LINK_VERSION && state.set instanceof Object ? Object.entries(state.set) : null;
    } catch {
        return null;
    }
}

/**
 * Applies a fragment's settings, leaving out values that do not fit this scene. Returns a notice about those, or "".
 */
export function restoreSettings(settings, fragment) {
    if (fragment.length < 2 && settings.isChanged()) settings.reset();
    if (!fragment.startsWith(PREFIX)) return "";
    const entries = parseFragment(fragment);
    if (entries === null) return "The link's settings cannot be read; the scene is shown without them.";
    settings.changes.clear();
    // The observer is validated as a whole, since one value may only be valid together with the next.
    const observer = { ...settings.observer() };
    let refused = 0;
    for (const [path, value] of panesLast(entries)) {
        const found = settings.find(path);
        if (found === null || validateValue(found.parameter, value) !== null) refused += 1;
        else if (path.startsWith("observer.")) observer[path.slice("observer.".length)] = value;
        else settings.set(path, value);
    }
    if (validateObserver(observer) === null) {
        for (const { name } of settings.observerParameters()) settings.set(`observer.${name}`, observer[name]);
    } else {
        refused += 1;
    }
    settings.notify(null);
    if (refused === 0) return "";
    return refused === 1
        ? "One of the link's settings does not fit this scene and was left out."
        : `${refused} of the link's settings do not fit this scene and were left out.`;
}
