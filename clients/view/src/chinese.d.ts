// Every sentence of the page in Chinese; build.mjs makes it.
declare module "chinese" {
  const words: Readonly<Record<string, string>>;
  export default words;
}
