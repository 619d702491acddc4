import { EXPOSURE_PATH } from "./parameters.js";

/** A value as TOML, the form that --set takes: numbers, arrays, booleans and texts. */
const tomlOf = (value) => JSON.stringify(value);

/** The changes as a pane shows them: pairs of a path and a value. */
function changesIn(settings, pane) {
    const prefix = `pane.${pane}.`, all = [...settings.changes];
    const own = all.filter(([path]) => path.startsWith(prefix)).map(([path, value]) => [path.slice(prefix.length), value]);
    return new Map([...all.filter(([path]) => !path.startsWith("pane.")), ...own]);
}

/** The name of a model in commands. */
const nameOf = (scene, kind, model) => {
    const { id } = scene[`${kind}_models`][model];
    return id === `${kind}/${model}` ? model : id;  // a kernel file is called by its path
};

/**
 * The page's changes as options of `candela render`: pairs of an option's name ("set", "shading", "reflection") and its value.
 * The display over and next to the picture is not part of the scene. Values of models that are not in use have no effect and
 * are left out. `pane`: the pane whose picture is meant; 0 is the first.
 */
export function optionsOf(allSettings, pane = 0) {
    const settings = allSettings.inPane(pane), { scene } = settings, options = [];
    for (const [path, value] of changesIn(settings, pane)) {
        const [kind, index, group, ...rest] = path.split(".");
        if (["show", "panes"].includes(kind)) continue;
        if (kind === "shading" || kind === "reflection") {
            if (value !== "") options.push([kind, nameOf(scene, kind, value)]);
        } else if (path === EXPOSURE_PATH) {
            options.push(["set", `observer.exposure=${tomlOf(value)}`]);
        } else if (kind === "light" && group === "on") {
            if (!value) options.push(["set", `light.${index}.intensity=0`]);
        } else if (kind === "light") {
            options.push(["set", `light.${index}.${rest[0]}=${tomlOf(value)}`]);
        } else if (kind === "object" && group === "common") {
            options.push(["set", `object.${index}.material.${rest[0]}=${tomlOf(value)}`]);
        } else if (kind === "object" && ["material", "shading"].includes(group)) {
            const model = group === "material" ? "reflection" : "shading";
            if (settings.modelOf(scene.objects[index], model) === rest[0]) options.push(["set", `object.${index}.${group}.${rest[1]}=${tomlOf(value)}`]);
        } else {
            options.push(["set", `${path}=${tomlOf(value)}`]);
        }
    }
    // A light whose intensity was changed and then switched off is off.
    return options.sort(([, a], [, b]) => Number(a.endsWith(".intensity=0")) - Number(b.endsWith(".intensity=0")));
}

/** The options as the query of an address. */
export const queryOf = (settings, pane) => optionsOf(settings, pane).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");

/** A word of a shell. */
export const quoted = (text) => (/^[\w.,=:+/-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/** The options as words of a shell. */
export const commandLineOf = (settings) => optionsOf(settings).map(([name, value]) => `--${name} ${quoted(value)}`).join(" ");
