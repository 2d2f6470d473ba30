"""The paper's PDE Face Generator (Fig. 8) in the browser: a server on this machine, and a page.

The server holds no document: it evaluates, opens, saves and exports what the page asks for. The
page morphs linearly by itself and takes the server's word after each gesture.
"""
