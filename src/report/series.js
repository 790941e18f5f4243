// Series that stand back are switched on and off: each in all pictures of its section.
for (const box of document.querySelectorAll("[data-switch]")) {
  const colour = box.dataset.line.split(" ").pop();
  const groups = [...box.closest("section").querySelectorAll("g.series")].filter((group) => group.dataset.series === box.dataset.switch);
  const grey = groups.map((group) => [group.getAttribute("stroke"), group.getAttribute("stroke-width")]);
  box.addEventListener("change", () => {
    groups.forEach((group, index) => {
      group.setAttribute("stroke", box.checked ? colour : grey[index][0]);
      group.setAttribute("fill", box.checked ? colour : grey[index][0]);
      group.setAttribute("stroke-width", box.checked ? 16 : grey[index][1]);
      group.parentNode.append(group);
    });
  });
}
