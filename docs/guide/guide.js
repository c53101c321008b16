// The pages link to files of the repository that the book does not contain: here their paths
// replace these links.
for (const link of document.querySelectorAll('main a[href^="../"]')) {
  const { pathname } = new URL(link.getAttribute("href"), "file:///docs/guide/src/");
  const path = document.createElement("code");
  path.className = "hljs"; // as the book marks code in a line
  path.textContent = pathname.slice(1).replace(/\.html$/, ".md");
  const text = link.textContent;
  const isPath = path.textContent.replace(/\.md$/, "") === text.replace(/\.md$/, "");
  link.replaceWith(...(isPath ? [path] : [text + " (", path, ")"]));
}
