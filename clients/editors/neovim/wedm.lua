-- wedm for Neovim 0.7 to 0.10. No plugin is needed. For 0.11 and later see lsp/wedm.lua.
--
--   :luafile /path/to/wedm.lua            or, in init.lua:
--   dofile('/path/to/wedm.lua').setup { settings = { correction = 0.12 } }
--
-- Options: cmd (default { 'wedm' }, of the PATH or ~/.cargo/bin), settings (see the README), on_attach(client, buffer).

local M = {}

local languages = { dxf = 'dxf', ['3b'] = '3b', ['4b'] = '3b', iso = 'wire-iso', nc = 'wire-iso' }
local clients = {} -- root folder -> client id

-- Deaths within this many seconds count together; after as many as there are delays (ms) the server stays down.
local forgiven_after = 120
local delays = { 0, 500, 1000, 2000, 4000 }
local deaths = {}

-- The program: on the PATH, or where `cargo install` puts it. A desktop often starts programs with another PATH than a shell has.
local function program()
    local own = vim.fn.expand('~/.cargo/bin/wedm')
    return vim.fn.executable('wedm') == 0 and vim.fn.executable(own) == 1 and own or 'wedm'
end

-- The folder of the nearest wedm.toml or .git above the file, else the file's own folder.
local function root_of(path)
    local folder = vim.fn.fnamemodify(path, ':p:h')
    local at = folder
    while true do
        for _, marker in ipairs { 'wedm.toml', '.git' } do
            if vim.loop.fs_stat(at .. '/' .. marker) then
                return at
            end
        end
        local above = vim.fn.fnamemodify(at, ':h')
        if above == at then
            return folder
        end
        at = above
    end
end

local function start(options, root)
    -- Neovim heeds the version that an edit was made for, and does not say so: without it a fix would be made in a text that has changed meanwhile.
    local capabilities = vim.lsp.protocol.make_client_capabilities()
    capabilities.workspace.workspaceEdit.documentChanges = true
    return vim.lsp.start_client {
        capabilities = capabilities,
        name = 'wedm',
        cmd = options.cmd,
        root_dir = root,
        workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
        init_options = options.settings or {},
        settings = { wedm = options.settings or {} },
        on_attach = options.on_attach,
        on_exit = function(code, signal)
            clients[root] = nil
            if code ~= 0 or signal ~= 0 then
                vim.schedule(function() M.again(options, root) end)
            end
        end,
    }
end

-- Starts a server that has died again. What is in its buffers now is opened in the new one.
function M.again(options, root)
    local buffers = vim.tbl_filter(function(buffer)
        return vim.api.nvim_buf_is_loaded(buffer) and vim.tbl_contains(vim.tbl_values(languages), vim.bo[buffer].filetype)
            and root_of(vim.api.nvim_buf_get_name(buffer)) == root
    end, vim.api.nvim_list_bufs())
    if #buffers == 0 or vim.v.exiting ~= vim.NIL then
        return
    end
    local now = vim.loop.now() / 1000
    deaths = vim.tbl_filter(function(death) return now - death < forgiven_after end, deaths)
    deaths[#deaths + 1] = now
    if not delays[#deaths] then
        vim.notify('wedm has ended ' .. #deaths .. ' times within two minutes and is not started again; its log: ' .. vim.lsp.get_log_path(),
            vim.log.levels.ERROR)
        return
    end
    vim.defer_fn(function()
        for _, buffer in ipairs(buffers) do
            if vim.api.nvim_buf_is_loaded(buffer) then
                M.attach(options, buffer)
            end
        end
    end, delays[#deaths])
end

function M.attach(options, buffer)
    local path = vim.api.nvim_buf_get_name(buffer)
    if path == '' then
        return
    end
    local root = root_of(path)
    if not (clients[root] and vim.lsp.get_client_by_id(clients[root])) then
        clients[root] = start(options, root)
    end
    if clients[root] then
        vim.lsp.buf_attach_client(buffer, clients[root])
        if vim.fn.has('nvim-0.8') == 0 then
            -- 0.7 stops to follow a buffer that is edited while it has no client, and does not start again. With the number of a client
            -- that there never is, it has one.
            vim.lsp.buf_attach_client(buffer, 0)
        end
    end
end

function M.setup(options)
    options = vim.tbl_extend('keep', options or {}, { cmd = { program() } })
    if vim.fn.executable(options.cmd[1]) == 0 then
        vim.notify('wedm: ' .. options.cmd[1] .. ' is neither on the PATH nor in ~/.cargo/bin; build it in a checkout of wedm with: cargo install --path .',
            vim.log.levels.WARN)
        return
    end
    local group = vim.api.nvim_create_augroup('wedm', { clear = true })
    vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
        group = group,
        pattern = { '*.dxf', '*.DXF', '*.3b', '*.3B', '*.4b', '*.4B', '*.iso', '*.ISO', '*.nc', '*.NC' },
        callback = function(event)
            local extension = vim.fn.fnamemodify(event.match, ':e'):lower()
            vim.bo[event.buf].filetype = languages[extension]
            M.attach(options, event.buf)
        end,
    })
end

return M
