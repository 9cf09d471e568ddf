// This starts `crt lsp` for the scripts that are open. All that the editor shows comes from there.
const { workspace } = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

let client;

function activate() {
  const settings = workspace.getConfiguration("crt");
  const server = {
    command: settings.get("command"),
    args: ["lsp"],
    transport: TransportKind.stdio,
  };
  client = new LanguageClient("crt", "CRT", server, {
    documentSelector: [{ language: "crt" }],
    initializationOptions: { resources: settings.get("resources") },
    synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.crt") },
  });
  return client.start();
}

function deactivate() {
  return client ? client.stop() : undefined;
}

module.exports = { activate, deactivate };
