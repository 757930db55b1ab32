#include "host/title_mark.h"

#include <QEvent>

namespace lampblack
{

namespace
{
const QString Placeholder = QStringLiteral("[*]"); ///< Qt shows it as "*" while the window is modified
const QString Mark = QStringLiteral("[*]*");
} // namespace

TitleMark::TitleMark(const Parts& parts, QObject* parent) : QObject(parent), mParts(parts)
{
    if (mParts.window != nullptr)
        mParts.window->installEventFilter(this);
}

TitleMark::~TitleMark()
{
    setMarked(false);
}

void TitleMark::setMarked(bool marked)
{
    mMarked = marked;
    update();
}

bool TitleMark::eventFilter(QObject* watched, QEvent* event)
{
    // Pencil2D sets the title anew when it opens or saves.
    if (watched == mParts.window &&
        (event->type() == QEvent::WindowTitleChange || event->type() == QEvent::ModifiedChange))
        update();
    return false;
}

void TitleMark::update()
{
    if (mParts.window == nullptr)
        return;
    const QString title = mParts.window->windowTitle();
    QString wanted = withoutMark(title);
    if (mMarked && !mParts.window->isWindowModified())
        wanted.replace(Placeholder, Mark);
    if (wanted != title)
        mParts.window->setWindowTitle(wanted);
}

QString withoutMark(QString title)
{
    return title.replace(Mark, Placeholder);
}

} // namespace lampblack
