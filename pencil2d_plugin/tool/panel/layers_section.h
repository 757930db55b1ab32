// The roles of the layers: characters and their lines are lit, backgrounds stay as drawn.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/section.h"

namespace lampblack
{

class LayersSection : public Section
{
    Q_OBJECT

public:
    LayersSection(Host& host, SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();
    void setRole(const QString& layer, const QString& role);

    Host& mHost;
    SceneDocument& mDocument;
    QWidget* mRows = nullptr;
};

} // namespace lampblack
