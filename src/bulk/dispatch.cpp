namespace bitshade {}
