// Marks the window's title while the light is not saved.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// Pencil2D marks its title while the drawings are not saved. While they are saved and the light is not, we
/// put the same asterisk there. The window's own flag stays as it is: it belongs to the drawings.
class TitleMark : public QObject
{
    Q_OBJECT

public:
    TitleMark(const Parts& parts, QObject* parent);
    ~TitleMark() override;

    void setMarked(bool marked);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void update();

    Parts mParts;
    bool mMarked = false;
};

/// `title` without the mark of the light.
QString withoutMark(QString title);

} // namespace lampblack
