-- wedm in Neovim 0.7 and later. In init.lua, where this folder is on the runtime path:
--
--   require('wedm').setup { settings = { correction = 0.12 } }
--
-- Options: cmd (default { 'wedm' }, of the PATH or ~/.cargo/bin), settings (see the README), on_attach(client, buffer).
-- In 0.11 and later `vim.lsp.enable('wedm')` alone does as well.

local M = {}

function M.setup(options)
    options = options or {}
    if vim.fn.has('nvim-0.11') == 0 then
        require('wedm.client').setup(options)
        return
    end
    local config = { cmd = options.cmd, on_attach = options.on_attach, settings = options.settings and { wedm = options.settings } }
    vim.lsp.config('wedm', config)
    vim.lsp.enable('wedm')
end

return M
