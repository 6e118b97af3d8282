import js from "@eslint/js";
import { defineConfig } from "eslint/config";
import tseslint from "typescript-eslint";

export default defineConfig(
  { ignores: ["**/dist/", "**/node_modules/", "vscode/tests/host/", "**/*.mjs", "picture/protocol.ts"] },
  js.configs.recommended,
  tseslint.configs.strictTypeChecked,
  tseslint.configs.stylisticTypeChecked,
  {
    languageOptions: { parserOptions: { project: ["vscode", "picture", "view", "vscode/webview", "vscode/tests"].map((folder) => new URL(`../${folder}/tsconfig.json`, import.meta.url).pathname) } },
    rules: {
      eqeqeq: "error",
      "@typescript-eslint/no-floating-promises": ["error", { allowForKnownSafeCalls: [{ from: "package", name: "test", package: "node:test" }] }],
      // VS Code's Disposable is a shape; what it returns is not of that class.
      "@typescript-eslint/no-unsafe-class-instance-assignment": "off",
      "@typescript-eslint/restrict-template-expressions": ["error", { allowNumber: true }],
      "@typescript-eslint/switch-exhaustiveness-check": "error",
      "max-len": ["error", { code: 140, ignoreUrls: true, ignoreTemplateLiterals: true, ignoreStrings: true }],
    },
  },
);
