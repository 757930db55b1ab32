// Our button in the tool palette, exclusive with the program's tools.
#pragma once

#include "host/parts.h"

namespace lampblack
{

class ToolPalette : public QObject
{
    Q_OBJECT

public:
    ToolPalette(const Parts& parts, QObject* parent);
    ~ToolPalette() override;

    void add(QAction* tool);

Q_SIGNALS:
    void activated(bool active);

private Q_SLOTS:
    void onToolChanged();

private:
    void deactivate();
    void onToggled(bool checked);
    void uncheckOthers();

    Parts mParts;
    QPointer<QAction> mAction;
    QPointer<QToolButton> mButton;
    QPointer<QToolButton> mBefore; ///< the tool that was active before ours
    bool mTemporarySwitch = false; ///< the program has changed its tool while a key is held
};

} // namespace lampblack
