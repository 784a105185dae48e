// Whether a person can get at everything: no scrolling sideways, nothing covered, nothing too small.

/** How many pixels of the page lie beyond the right edge of the window. */
export function sidewaysScroll(page) {
  return page.evaluate(() => Math.max(0, document.documentElement.scrollWidth - document.documentElement.clientWidth));
}

/** Names of the controls that cannot be scrolled to and hit, or are smaller than a finger can hit. */
export function unreachableControls(page) {
  return page.evaluate(() => {
    const minSize = 24;  // CSS pixels; WCAG 2.2, 2.5.8
    const nameOf = (node) => node.getAttribute("aria-label") || node.id || node.textContent.trim();
    const problemOf = (node) => {
      node.scrollIntoView({ block: "center", inline: "center", behavior: "instant" });
      const { left, top, width, height } = node.getBoundingClientRect();
      const x = left + width / 2, y = top + height / 2;
      if (x < 0 || y < 0 || x > innerWidth || y > innerHeight) return "is out of reach";
      const hit = document.elementFromPoint(x, y);
      if (hit === null || !(node.contains(hit) || node.labels?.[0]?.contains(hit))) return `is covered by ${hit?.tagName} ${hit?.className}`;
      const isSmall = node.tagName !== "INPUT" && Math.min(width, height) < minSize;
      return isSmall ? `is ${width.toFixed(0)} by ${height.toFixed(0)}` : null;
    };
    const controls = [...document.querySelectorAll("button, select, input, summary")].filter((node) => node.checkVisibility());
    const problems = controls.map((node) => [nameOf(node), problemOf(node)]).filter(([, problem]) => problem !== null);
    if (controls.length < 10) problems.push(["controls", `only ${controls.length} are there`]);
    return problems.map((parts) => parts.join(" "));
  });
}
