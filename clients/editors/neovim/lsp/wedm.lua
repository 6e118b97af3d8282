-- wedm for the client that Neovim has built in since 0.11: `vim.lsp.enable('wedm')`, with this folder on the runtime path.

local program = require('wedm.program')
local restarts = require('wedm.restarts')

-- Neovim stops tracking a buffer that is edited while it has no client, and does not resume when it gets one. Until the server is
-- back, buffers have this client, which does nothing.
local function placeholder(dispatchers)
    local closing = false
    local function close()
        if not closing then
            closing = true
            dispatchers.on_exit(0, 0)
        end
    end
    return {
        request = function(method, _, answer)
            vim.schedule(function() answer(nil, method == 'initialize' and { capabilities = {} } or nil) end)
            return true, 1
        end,
        notify = function(method)
            if method == 'exit' then
                close()
            end
            return true
        end,
        is_closing = function() return closing end,
        terminate = close,
    }
end

-- Starts a server again that has ended, for the buffers that it had.
local function again(client_id, code, signal)
    local client = vim.lsp.get_client_by_id(client_id)
    local buffers = vim.tbl_filter(vim.api.nvim_buf_is_loaded, vim.tbl_keys(client and client.attached_buffers or {}))
    if vim.v.exiting ~= vim.NIL or #buffers == 0 then
        return
    end
    local pause = restarts.after(client_id, code, signal)
    if not pause then
        return
    end
    for _, buffer in ipairs(buffers) do
        vim.lsp.start({ name = 'wedm-waits', cmd = placeholder }, { bufnr = buffer, silent = true })
    end
    vim.defer_fn(function()
        if vim.lsp.is_enabled('wedm') then
            -- What is in the buffers now is opened in the new server.
            vim.lsp.enable('wedm', true)
        end
        for _, waiting in ipairs(vim.lsp.get_clients { name = 'wedm-waits' }) do
            waiting:stop()
        end
    end, pause)
end

-- Said once, when the first drawing is opened; the command may be set after this file.
vim.schedule(function()
    local command = vim.lsp.config.wedm.cmd
    if type(command) == 'table' then
        program.is_there(command[1])
    end
end)

return {
    cmd = { program.find() },
    filetypes = { 'dxf', '3b', 'wire-iso' },
    -- Neovim heeds the version of an edit but does not announce it: without this a fix would be made in a text that has changed in the meantime.
    capabilities = { workspace = { workspaceEdit = { documentChanges = true } } },
    root_markers = { 'wedm.toml', '.git' },
    before_init = function(params, config)
        -- The settings hold from the first document on.
        local own = config.settings and config.settings.wedm or {}
        -- An empty table of Lua would be sent as a list.
        params.initializationOptions = next(own) and own or vim.empty_dict()
        restarts.watch(vim.tbl_filter(function(client) return client.config == config end, vim.lsp.get_clients { _uninitialized = true })[1])
    end,
    on_init = restarts.answered,
    on_error = function(code) restarts.erred(code) end,
    on_exit = function(code, signal, client_id)
        vim.schedule(function() again(client_id, code, signal) end)
    end,
}
