/** For screen readers; the text's content is visible anyway. */
export function announce(text) {
    document.getElementById("status").textContent = text;
}

/** Null hides the error shown before. */
export function showError(error) {
    const box = document.getElementById("problem-box");
    box.hidden = error === null;
    if (error === null) return;
    document.getElementById("problem-text").textContent = error.message;
    document.getElementById("problem-detail").textContent = error.detail ?? "";
    document.getElementById("problem-more").hidden = !error.detail;
    document.getElementById("problem-more").open = document.body.classList.contains("failed");
}

/** Shows the errors of the scene's file, which the page follows; an empty text hides them. */
export function showSceneProblems(text) {
    document.getElementById("scene-problems-text").textContent = text;
    document.getElementById("scene-problems").hidden = text === "";
}

/** An empty text hides the notice. */
export function showNotice(text) {
    document.getElementById("notice").textContent = text;
    document.getElementById("notice").hidden = text === "";
}
