-- This has Neovim 0.10 or later serve CRT scripts by `crt lsp`. See README.md for where it goes.
vim.filetype.add({ extension = { crt = "crt" } })

vim.api.nvim_create_autocmd("FileType", {
  pattern = "crt",
  callback = function(event)
    vim.bo[event.buf].commentstring = "-- %s"
    vim.lsp.start({
      name = "crt",
      cmd = { "crt", "lsp" },
      root_dir = vim.fs.dirname(vim.api.nvim_buf_get_name(event.buf)),
      init_options = { resources = {} }, -- folders, as of `crt render --resources`
    })
  end,
})
