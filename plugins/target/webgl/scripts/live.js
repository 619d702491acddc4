import { addArray, hasArray, keepArrays } from "../../../../sdk/web/arrays.js";
import { announce, showNotice, showSceneProblems } from "./messages.js";

const RETRY_MS = 1000;
const MOST_PARTS = 50;  // in one request, whose length is limited
const ENDED = "candela view has ended or cannot be reached; this is the last picture.";

/** Texts of elements of another generation of this page; null if the server has moved on to a newer one. */
async function fetchParts(generation, ids) {
    const response = await fetch([`?live=${generation}`, ...ids.map((id) => `part=${id}`)].join("&"));
    const newest = Number(new URL(response.url).searchParams.get("live"));
    if (!response.ok && newest === generation) throw new Error(`The scene cannot be fetched (${response.status}).`);
    return { generation: newest, texts: response.ok ? (await response.text()).split("\n") : null };
}

/** The scene of another generation of this page, or of a newer one, with the arrays that this page does not have yet. */
async function fetchScene(wanted) {
    const { generation, texts } = await fetchParts(wanted, ["scene"]);
    const scene = JSON.parse(texts[0]);
    const missing = scene.arrays.filter((name) => !hasArray(name));
    for (let i = 0; i < missing.length; i += MOST_PARTS) {
        const names = missing.slice(i, i + MOST_PARTS), arrays = await fetchParts(generation, names);
        if (arrays.generation !== generation) return fetchScene(arrays.generation);
        names.forEach((name, k) => addArray(name, arrays.texts[k]));
    }
    return { scene, generation };
}

/** Whether `candela view` serves the page: the address then contains its generation. */
export const isServed = () => new URLSearchParams(location.search).has("live");

/**
 * Keeps the page up to date if `candela view` serves it. `show` takes a scene. Without a server, does nothing and returns
 * false.
 */
export function followScene(show, onError) {
    if (!isServed()) return false;
    let shown = Number(new URLSearchParams(location.search).get("live")), wanted = shown, isFetching = false;
    const update = async () => {
        if (isFetching) return;
        isFetching = true;
        let isMissing = false;
        try {
            while (wanted > shown) {
                isMissing = true;
                const { scene, generation } = await fetchScene(wanted);
                isMissing = false;
                show(scene);
                keepArrays(scene.arrays);
                shown = generation;
                history.replaceState(null, "", `?live=${shown}${location.hash}`);
                announce("The scene's file was saved; the page shows the new version.");
            }
            onError(null);
        } catch (error) {
            onError(error);
            // No further event would cause it to be fetched.
            if (isMissing) setTimeout(update, RETRY_MS);
        } finally {
            isFetching = false;
        }
    };
    const events = new EventSource("events");
    events.addEventListener("scene", (event) => {
        wanted = Number(event.data);
        if (wanted > shown) update();
    });
    events.addEventListener("problems", (event) => showSceneProblems(JSON.parse(event.data)));
    events.addEventListener("open", () => showNotice(""));
    events.addEventListener("error", () => showNotice(ENDED));
    return true;
}
