// The context menu of the Depth view.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/depth/cut_editor.h"

#include <QMenu>

#include <functional>

namespace lampblack
{

/// Rebuilt each time it opens.
class CutMenu : public QMenu
{
    Q_OBJECT

public:
    CutMenu(Host& host, SceneDocument& document, CutEditor& editor, QWidget* parent);

    /// `cut` is the cut under the pointer, or null. `colour` is the flat colour there, or empty.
    void openAt(const Cut* cut, const QPoint& global, const QString& colour = {});
    /// `stroke` is the index of the stroke of the brush under the pointer, or -1.
    void openAtStroke(int stroke, const QPoint& global, const QString& colour = {});

Q_SIGNALS:
    void lightRequested(); ///< to leave the Depth view

private:
    void fillCut(const Cut& cut);
    void fillFrame();
    void fillColour(const QString& colour);
    void addLight();
    QAction* addEntry(const char* name, const QString& text, const std::function<void()>& onTriggered);

    Host& mHost;
    SceneDocument& mDocument;
    CutEditor& mEditor;
};

} // namespace lampblack
