-- wedm for the client that Neovim has built in since 0.11. In init.lua:
--
--   vim.opt.runtimepath:append('/path/to/wedm/clients/editors/neovim')
--   vim.lsp.config('wedm', { settings = { wedm = { correction = 0.12 } } })
--   vim.lsp.enable('wedm')

-- Deaths within this many seconds count together; after as many as there are delays the server stays down.
local forgiven_after = 120
local delays = { 0, 500, 1000, 2000, 4000 }
-- Neovim reads this file again each time that the server is enabled: what is to be remembered stands outside.
local memory = package.loaded['wedm.deaths'] or { deaths = {} }
package.loaded['wedm.deaths'] = memory

-- Neovim stops to follow a buffer that is edited while it has no client, and does not start again when it gets one. Until the server is
-- back, buffers have this one, which knows nothing.
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

-- Starts a server again that has died, for the buffers that it had.
local function again(client_id)
    local client = vim.lsp.get_client_by_id(client_id)
    local buffers = vim.tbl_filter(vim.api.nvim_buf_is_loaded, vim.tbl_keys(client and client.attached_buffers or {}))
    if vim.v.exiting ~= vim.NIL or #buffers == 0 then
        return
    end
    local now = vim.uv.now() / 1000
    local deaths = vim.tbl_filter(function(death) return now - death < forgiven_after end, memory.deaths)
    deaths[#deaths + 1] = now
    memory.deaths = deaths
    local delay = delays[#deaths]
    if not delay then
        vim.notify('wedm has ended ' .. #deaths .. ' times within two minutes and is not started again; see :LspLog', vim.log.levels.ERROR)
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
    end, delay)
end

-- The program: on the PATH, or where `cargo install` puts it. A desktop often starts programs with another PATH than a shell has.
local function program()
    local own = vim.fn.expand('~/.cargo/bin/wedm')
    return vim.fn.executable('wedm') == 0 and vim.fn.executable(own) == 1 and own or 'wedm'
end

-- Said once, when the first drawing is opened; the command may be set behind this file.
vim.schedule(function()
    local command = vim.lsp.config.wedm.cmd
    if type(command) == 'table' and vim.fn.executable(command[1]) == 0 then
        vim.notify('wedm: ' .. command[1] .. ' is neither on the PATH nor in ~/.cargo/bin; build it in a checkout of wedm with: cargo install --path .', vim.log.levels.WARN)
    end
end)

return {
    cmd = { program() },
    filetypes = { 'dxf', '3b', 'wire-iso' },
    -- Neovim heeds the version that an edit was made for, and does not say so: without it a fix would be made in a text that has changed meanwhile.
    capabilities = { workspace = { workspaceEdit = { documentChanges = true } } },
    root_markers = { 'wedm.toml', '.git' },
    before_init = function(params, config)
        -- The settings hold from the first document on.
        params.initializationOptions = config.settings and config.settings.wedm or vim.empty_dict()
    end,
    on_exit = function(code, signal, client_id)
        if code ~= 0 or signal ~= 0 then
            vim.schedule(function() again(client_id) end)
        end
    end,
}
