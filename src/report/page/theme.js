// Light, dark, or as the system has it.

const THEMES = ['auto', 'light', 'dark'];

/** The choice of an earlier visit; storage may be forbidden for files. */
function keptTheme() {
  try {
    return localStorage.getItem('tyndall-theme');
  } catch {
    return null;
  }
}

function keepTheme(theme) {
  try {
    localStorage.setItem('tyndall-theme', theme);
  } catch { /* it lasts until the page is closed */
  }
}

function themeSwitch() {
  const choose = (theme) => {
    if (theme === 'auto')
      delete document.documentElement.dataset.theme;
    else
      document.documentElement.dataset.theme = theme;
    keepTheme(theme);
    press(theme);
  };
  const {group, press} =
      segmented('Colours of the page', THEMES.map((theme) => [theme, theme[0].toUpperCase() + theme.slice(1)]), choose);
  group.classList.add('theme');
  choose(THEMES.includes(keptTheme()) ? keptTheme() : 'auto');
  return group;
}
