// What the page says: news for everybody's ears, problems for everybody's eyes.

function tell(text) {
    document.getElementById("status").textContent = text;
}

/// Null: all is well again.
function showProblem(problem) {
    const box = document.getElementById("problem-box");
    box.hidden = problem === null;
    if (problem === null) return;
    document.getElementById("problem-text").textContent = problem.message;
    document.getElementById("problem-detail").textContent = problem.detail ?? "";
    document.getElementById("problem-more").hidden = !problem.detail;
    document.getElementById("problem-more").open = document.body.classList.contains("failed");
}

function showNotice(text) {
    document.getElementById("notice").textContent = text;
    document.getElementById("notice").hidden = text === "";
}
