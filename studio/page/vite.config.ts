import { defineConfig } from 'vite';

// Files of fixed names: the program embeds them (studio/CMakeLists.txt).
export default defineConfig({
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact', legalComments: 'none' },
  build: {
    target: 'es2022',
    modulePreload: false,
    chunkSizeWarningLimit: 1500,
    rollupOptions: {
      output: {
        inlineDynamicImports: true,
        entryFileNames: 'studio.js',
        assetFileNames: 'studio.[ext]',
      },
    },
  },
});
