// The buttons under the picture.

async function copy(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}

/// A picture as a PNG file in a data: address.
function pngOf(pixels, width, height) {
    const canvas = element("canvas", { width, height });
    canvas.getContext("2d").putImageData(new ImageData(pixels, width, height), 0, 0);
    return canvas.toDataURL("image/png");
}

function connectActions(settings, render) {
    const button = (id, deed) => document.getElementById(id).addEventListener("click", deed);
    button("reset-view", () => {
        settings.resetView();
        tell("The view is as the scene says.");
    });
    button("reset-all", () => {
        settings.reset();
        showNotice("");
        history.replaceState(null, "", location.pathname + location.search);
        tell("All is as the scene says.");
    });
    button("copy-link", async () => {
        history.replaceState(null, "", fragmentOf(settings) || location.pathname + location.search);
        const isCopied = await copy(location.href);
        tell(isCopied ? "The link is copied." : "The link is in the address bar.");
    });
    button("save-picture", async () => {
        const { width, height } = settings.scene.image;
        try {
            const href = pngOf(await render(width, height), width, height);
            element("a", { href, download: `${settings.scene.title}.png` }).click();
            tell("The picture is saved.");
        } catch (problem) {
            showProblem(problem);
        }
    });
}
