// Light or dark, English or Chinese: as the system and the program say, until somebody chooses here.

import { speak } from "../../picture/words";
import chinese from "chinese";

const THEME = "wedm.theme";
const LANGUAGE = "wedm.language";

export type Language = "en" | "zh";

const dark = matchMedia("(prefers-color-scheme: dark)");

export function isDark(): boolean {
  const chosen = localStorage.getItem(THEME);
  return chosen === null ? dark.matches : chosen === "dark";
}

/** `changed` when the colours are others. */
export function wearTheme(changed: () => void): void {
  const wear = (): void => {
    document.documentElement.dataset["theme"] = isDark() ? "dark" : "light";
    changed();
  };
  dark.addEventListener("change", wear);
  window.addEventListener("storage", wear);
  wear();
}

export function switchTheme(): void {
  localStorage.setItem(THEME, isDark() ? "light" : "dark");
  window.dispatchEvent(new StorageEvent("storage"));
}

export function chooseLanguage(ofProgram: Language): Language {
  const chosen = localStorage.getItem(LANGUAGE);
  const language = chosen === "en" || chosen === "zh" ? chosen : ofProgram;
  document.documentElement.lang = language === "zh" ? "zh-CN" : "en";
  speak(language === "zh" ? chinese : {});
  return language;
}

export function switchLanguage(now: Language): void {
  localStorage.setItem(LANGUAGE, now === "zh" ? "en" : "zh");
  location.reload();
}
